// Sorts particles into the cells of a periodic grid by a counting sort. The cells of the positions are found by SIMD
// code, compiled once per instruction set: without it, building the neighbor list of a powder takes a seventh longer
// (`globular bench --filter list`).
#include "engine/neighbors/cell_grid.h"

#include <algorithm>
#include <cmath>

#include "engine/core/bounding_box.h"
#include "engine/core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/neighbors/cell_grid.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<double> kTag{};
constexpr hn::RebindToUnsigned<decltype(kTag)> kBits{};
constexpr hn::Rebind<std::uint32_t, decltype(kTag)> kCells{};
using V = hn::Vec<decltype(kTag)>;

/// The constants of a CellAxis, broadcast to every SIMD lane. Cell numbers are integers that a double represents
/// exactly.
struct AxisLanes {
    V width, size, first, stored;

    explicit AxisLanes(const CellAxis& axis)
        : width(hn::Set(kTag, axis.width)),
          size(hn::Set(kTag, static_cast<double>(axis.size))),
          first(hn::Set(kTag, static_cast<double>(axis.first))),
          stored(hn::Set(kTag, static_cast<double>(axis.stored))) {}

    /// Difference of a coordinate's cell number from the number of the grid's lowest cell.
    V stepsTo(V coordinate) const { return hn::Sub(hn::Floor(hn::Div(coordinate, width)), first); }

    /// Whether cells this many cells beyond the first one are within the size of the grid; a NaN is not.
    hn::Mask<decltype(kTag)> areInside(V steps) const {
        return hn::And(hn::Ge(steps, hn::Zero(kTag)), hn::Lt(steps, size));
    }

    V cellAfter(V steps) const {
        const V cell = hn::Add(stored, steps);
        return hn::IfThenElse(hn::Lt(cell, size), cell, hn::Sub(cell, size));
    }
};

void findCellsHere(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells) {
    const AxisLanes alongX(axes[0]), alongY(axes[1]), alongZ(axes[2]);
    const std::size_t lanes = hn::Lanes(kTag);
    const V integer = hn::Set(kTag, 0x1p52);  // adding it to a double puts the integer part into the last 32 bits
    std::size_t p = 0;
    for (; p + lanes <= count; p += lanes) {
        V x, y, z;
        hn::LoadInterleaved3(kTag, positions[p].data(), x, y, z);
        x = alongX.stepsTo(x);
        y = alongY.stepsTo(y);
        z = alongZ.stepsTo(z);
        if (!hn::AllTrue(kTag, hn::And(alongX.areInside(x), hn::And(alongY.areInside(y), alongZ.areInside(z))))) {
            for (std::size_t k = p; k < p + lanes; ++k) cells[k] = cellAt(axes, positions[k]);
            continue;
        }
        const V row = hn::Add(hn::Mul(alongZ.cellAfter(z), alongY.size), alongY.cellAfter(y));
        const V cell = hn::Add(hn::Mul(row, alongX.size), alongX.cellAfter(x));
        hn::StoreU(hn::TruncateTo(kCells, hn::BitCast(kBits, hn::Add(cell, integer))), kCells, cells + p);
    }
    for (; p < count; ++p) cells[p] = cellAt(axes, positions[p]);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(findCellsHere);

namespace {

/// Fewest cells along an axis: the cells before and after each cell are then two. The order in which neighbors are
/// found, and with it the last bits of forces, depends on the positions of the neighbors alone, not on the extent of
/// the particles, of which a rank sees only its part.
constexpr double kFewestCells = 3.0;

/// Largest number of cells: about two for each particle, so that the size of the grid is linear in the number of
/// particles even if they are far apart.
std::int64_t cellLimit(std::size_t particleCount) {
    return std::max<std::int64_t>(64, 2 * static_cast<std::int64_t>(particleCount));
}

std::array<std::int64_t, 3> chooseDimensions(const BoundingBox& extent, std::size_t particleCount, double width) {
    const std::int64_t limit = cellLimit(particleCount);
    std::array<std::int64_t, 3> dimensions{};
    for (int axis = 0; axis < 3; ++axis) {
        const double along = std::floor((extent.high[axis] - extent.low[axis]) / width) + 2.0;
        // std::min(limit, x) returns limit when x is NaN; the reverse order would not.
        dimensions[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>(std::max(kFewestCells, std::min(static_cast<double>(limit), along)));
    }
    // Any larger number of cells gives correct neighbors. Halving the longest axis keeps cells that share storage far
    // apart, and leaves at least three, because an axis of four is not halved: 4 x 4 x 4 cells are within any limit.
    const auto cells = [&] {
        return static_cast<double>(dimensions[0]) * static_cast<double>(dimensions[1]) *
               static_cast<double>(dimensions[2]);
    };
    while (cells() > static_cast<double>(limit)) {
        std::int64_t& longest = *std::max_element(dimensions.begin(), dimensions.end());
        longest = (longest + 1) / 2;
    }
    return dimensions;
}

/// Indices of a cell along x, y and z.
std::array<std::int64_t, 3> indicesOf(const CellGrid& grid, std::uint32_t cell) {
    // The division is in 32 bits, which hold the index of any cell, because it takes half as long as one in 64 bits.
    const auto nx = static_cast<std::uint32_t>(grid.dimensions[0]);
    const auto ny = static_cast<std::uint32_t>(grid.dimensions[1]);
    return {cell % nx, cell / nx % ny, cell / nx / ny};
}

}  // namespace

void findCells(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells) {
    HWY_DYNAMIC_DISPATCH(findCellsHere)(axes, positions, count, cells);
}

void build(CellGrid& grid, const std::vector<Vec3>& positions, double cellWidth) {
    grid.order.resize(positions.size());
    grid.cellOf.resize(positions.size());
    grid.start.assign(2, 0);
    grid.dimensions = {1, 1, 1};
    if (positions.empty()) return;

    const double width = cellWidth * kRoundingMargin;
    grid.width = width;
    const BoundingBox extent =
        boundingBoxOf(positions.size(), [&](std::size_t p) -> const Vec3& { return positions[p]; });
    grid.dimensions = chooseDimensions(extent, positions.size(), width);
    const std::array<std::int64_t, 3>& size = grid.dimensions;
    // There is one entry more than needed, and counts are stored two entries further on, so that after the particles
    // are filled in below every entry is the start of its cell.
    grid.start.assign(static_cast<std::size_t>(size[0] * size[1] * size[2]) + 2, 0);
    const CellAxes axes{CellAxis(width, size[0], extent.low.x()), CellAxis(width, size[1], extent.low.y()),
                        CellAxis(width, size[2], extent.low.z())};
    inRanges(positions.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        findCells(axes, &positions[begin], end - begin, &grid.cellOf[begin]);
    });
    for (const std::uint32_t cell : grid.cellOf) ++grid.start[cell + 2];
    for (std::size_t at = 2; at < grid.start.size(); ++at) grid.start[at] += grid.start[at - 1];
    for (std::size_t p = 0; p < positions.size(); ++p)
        grid.order[grid.start[grid.cellOf[p] + 1]++] = static_cast<std::uint32_t>(p);
    grid.start.pop_back();
}

std::uint32_t cellOfSortedIndex(const CellGrid& grid, std::uint32_t sortedIndex) {
    const auto next = std::upper_bound(grid.start.begin(), grid.start.end(), sortedIndex);
    return static_cast<std::uint32_t>(next - grid.start.begin() - 1);
}

CellRun runFrom(const CellGrid& grid, std::uint32_t cell, std::uint32_t mostParticles, std::uint32_t mostCells) {
    const auto nx = static_cast<std::uint32_t>(grid.dimensions[0]);
    const std::uint32_t x = cell % nx;
    CellRun run{cell, cell};
    if (x == 0) return run;
    const std::uint32_t end = std::min(cell + mostCells, cell - x + nx - 1);
    while (run.last + 1 < end && grid.start[run.last + 2] - grid.start[cell] <= mostParticles) ++run.last;
    return run;
}

Neighborhood neighborhood(const CellGrid& grid, const CellRun& run) {
    const auto [nx, ny, nz] = grid.dimensions;
    const auto [x, y, z] = indicesOf(grid, run.first);
    const std::int64_t lastX = x + run.last - run.first;
    Neighborhood found;
    const auto add = [&](std::int64_t from, std::int64_t last) {
        const CellRange range{grid.start[static_cast<std::size_t>(from)],
                              grid.start[static_cast<std::size_t>(last) + 1]};
        if (range.begin == range.end) return;
        CellRange* before = found.count > 0 ? &found.ranges[static_cast<std::size_t>(found.count - 1)] : nullptr;
        if (before != nullptr && before->end == range.begin)
            before->end = range.end;
        else
            found.ranges[static_cast<std::size_t>(found.count++)] = range;
    };
    const bool isInside = x > 0 && lastX + 1 < nx;  // the run and its neighbors along x are consecutive
    for (std::int64_t dz = -1; dz <= 1; ++dz) {
        for (std::int64_t dy = -1; dy <= 1; ++dy) {
            const std::int64_t first = (wrappedStep(z + dz, nz) * ny + wrappedStep(y + dy, ny)) * nx;
            if (isInside) {
                add(first + x - 1, first + lastX + 1);
                continue;
            }
            for (std::int64_t dx = -1; dx <= 1; ++dx) {
                const std::int64_t at = first + wrappedStep(x + dx, nx);
                add(at, at);
            }
        }
    }
    return found;
}

void appendRanges(const CellGrid& grid, const BoundingBox& box, std::vector<CellRange>& ranges) {
    if (grid.order.empty()) return;
    std::array<std::int64_t, 3> first{};
    std::array<std::int64_t, 3> count{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        const std::int64_t low = cellNumber(box.low[at], grid.width);
        const std::int64_t high = cellNumber(box.high[at], grid.width);
        count[axis] = std::min(high - low + 1, grid.dimensions[axis]);
        first[axis] = wrapped(low, grid.dimensions[axis]);
    }
    const auto [nx, ny, nz] = grid.dimensions;
    const std::size_t before = ranges.size();
    const auto add = [&](std::int64_t from, std::int64_t end) {
        const CellRange range{grid.start[static_cast<std::size_t>(from)], grid.start[static_cast<std::size_t>(end)]};
        if (range.begin == range.end) return;
        if (ranges.size() > before && ranges.back().end == range.begin)
            ranges.back().end = range.end;
        else
            ranges.push_back(range);
    };
    for (std::int64_t z = 0; z < count[2]; ++z)
        for (std::int64_t y = 0; y < count[1]; ++y) {
            const std::int64_t line = (wrappedStep(first[2] + z, nz) * ny + wrappedStep(first[1] + y, ny)) * nx;
            // The cells of a line that lie beyond its end are stored at its beginning.
            add(line + first[0], line + std::min(first[0] + count[0], nx));
            if (first[0] + count[0] > nx) add(line, line + first[0] + count[0] - nx);
        }
}

}  // namespace engine

#endif
