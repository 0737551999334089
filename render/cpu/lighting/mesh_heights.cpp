// Triangles with Highway; this file is compiled once per instruction set. A lane is a row that a triangle covers, and
// then a column of such a row: branches on single rows and columns would be mispredicted too often.
#include "render/cpu/lighting/mesh_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/lighting/mesh_heights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/lighting/depth_map.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Rows, with numbers in double precision. Not more at once, because the triangles of a fine mesh cover few (measured:
// with eight, 100,000 triangles take a tenth more time).
constexpr std::size_t kMostRows = 4;
using DRow = hn::CappedTag<double, kMostRows>;
using VRow = hn::Vec<DRow>;

// Columns. A map is wider than this, because it has a margin of three texels.
using DColumn = hn::CappedTag<float, 8>;

// How far beyond its edges a triangle covers heights, in distances between heights: more than the rounding, so that no
// light falls between two triangles.
constexpr double kSlack = 1.0e-3;

HWY_INLINE VRow splat(double value) {
    return hn::Set(DRow(), value);
}

/// What a triangle covers of some rows.
struct CoveredRows {
    alignas(64) std::array<std::int32_t, kMostRows> first, last;  ///< columns; none if last < first
    alignas(64) std::array<float, kMostRows> start;               ///< height at the first column, steps
};

/// A triangle, and how its height changes.
class HeightTriangle {
 public:
    HeightTriangle(const HeightTriangles& all, std::uint32_t index) {
        for (std::size_t k = 0; k < 3; ++k) at_[k] = glm::dvec3(all.corners[all.triangles[index].corners[k]]);
        const glm::dvec3 b = at_[1] - at_[0];
        const glm::dvec3 c = at_[2] - at_[0];
        const double area = b.x * c.y - b.y * c.x;
        slopeX_ = (b.z * c.y - c.z * b.y) / area;
        slopeY_ = (c.z * b.x - b.z * c.x) / area;
        low_ = stepsOf(std::min({at_[0].z, at_[1].z, at_[2].z}));
        high_ = stepsOf(std::max({at_[0].z, at_[1].z, at_[2].z}));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 along = at_[(k + 1) % 3] - at_[k];
            slopes_[k] = along.y == 0.0 ? 0.0 : along.x / along.y;
        }
    }

    /// The first and the last of these rows that the triangle may cover.
    glm::ivec2 rowsWithin(const HeightRows& rows) const {
        const double top = std::min({at_[0].y, at_[1].y, at_[2].y});
        const double bottom = std::max({at_[0].y, at_[1].y, at_[2].y});
        return {std::max(rows.first, static_cast<int>(std::ceil(std::max(top, 0.0)))),
                std::min(rows.last, static_cast<int>(std::floor(bottom)))};
    }

    /// Finds the columns between the edges of the triangle that cross rows. An edge crosses a row at the same place in
    /// both of its triangles, up to the rounding.
    /// @param firstRow  of as many as there are lanes
    void cover(int firstRow, int columns, CoveredRows& covered) const {
        const DRow d;
        const VRow row = hn::Iota(d, static_cast<double>(firstRow));
        VRow least = splat(std::numeric_limits<double>::max());
        VRow most = splat(std::numeric_limits<double>::lowest());
        const auto addWhere = [&](auto where, VRow x) {
            least = hn::IfThenElse(where, hn::Min(least, x), least);
            most = hn::IfThenElse(where, hn::Max(most, x), most);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& from = at_[k];
            const glm::dvec3& to = at_[(k + 1) % 3];
            addWhere(splat(from.y) == row, splat(from.x));
            const VRow x = splat(from.x) + (row - splat(from.y)) * splat(slopes_[k]);
            addWhere(hn::Xor(splat(from.y) < row, splat(to.y) < row), x);
        }
        const VRow first = hn::Max(hn::Ceil(least - splat(kSlack)), splat(0.0));
        const VRow last = hn::Min(hn::Floor(most + splat(kSlack)), splat(columns - 1));
        const VRow across = splat(slopeX_) * (first - splat(at_[0].x));
        const VRow start = splat(at_[0].z) + across + splat(slopeY_) * (row - splat(at_[0].y));
        const hn::Rebind<std::int32_t, DRow> toInt;
        hn::Store(hn::DemoteTo(toInt, hn::Min(first, splat(columns))), toInt, covered.first.data());
        hn::Store(hn::DemoteTo(toInt, hn::Max(last, splat(-1.0))), toInt, covered.last.data());
        const hn::Rebind<float, DRow> toFloat;
        hn::Store(hn::DemoteTo(toFloat, start), toFloat, covered.start.data());
    }

    /// Draws columns of a row.
    /// @param heights  of the row
    /// @param start    height at the first of these columns, steps
    void draw(int first, int last, float start, int columns, std::uint16_t* heights) const {
        const DColumn d;
        const auto lanes = static_cast<int>(hn::Lanes(d));
        const auto set = [&](float value) { return hn::Set(d, value); };
        for (int next = first; next <= last; next += lanes) {
            // The vector does not reach beyond the end of the row, because the next row may be drawn at the same time.
            const int from = std::min(next, columns - lanes);
            const auto column = hn::Iota(d, static_cast<float>(from - first));
            const auto height = set(start) + set(static_cast<float>(slopeX_)) * column;
            const auto clamped = hn::Min(hn::Max(height, set(low_)), set(high_));
            const auto isCovered = hn::And(column >= set(0.0F), column <= set(static_cast<float>(last - first)));
            const auto steps = hn::ConvertTo(hn::RebindToSigned<DColumn>(), clamped + set(0.5F));
            const auto covered = hn::IfThenElseZero(hn::RebindMask(hn::RebindToSigned<DColumn>(), isCovered), steps);
            const hn::Rebind<std::uint16_t, DColumn> narrow;
            hn::StoreU(hn::Max(hn::LoadU(narrow, heights + from), hn::DemoteTo(narrow, covered)), narrow,
                       heights + from);
        }
    }

 private:
    static float stepsOf(double height) {
        return static_cast<float>(std::clamp(height, 0.0, static_cast<double>(kMostSteps)));
    }

    std::array<glm::dvec3, 3> at_;  // the corners
    double slopeX_, slopeY_;        // what a column and a row add to the height, steps
    float low_, high_;              // least and greatest height, steps
    std::array<double, 3> slopes_;  // of each edge, columns a row
};

void drawTriangles(const HeightTriangles& triangles, std::span<const std::uint32_t> indices, const HeightRows& rows) {
    const auto lanes = static_cast<int>(hn::Lanes(DRow()));
    CoveredRows covered;
    for (const std::uint32_t index : indices) {
        const HeightTriangle triangle(triangles, index);
        const glm::ivec2 ends = triangle.rowsWithin(rows);
        for (int first = ends[0]; first <= ends[1]; first += lanes) {
            triangle.cover(first, rows.columns, covered);
            for (int row = first; row <= std::min(first + lanes - 1, ends[1]); ++row) {
                const auto k = static_cast<std::size_t>(row - first);
                triangle.draw(covered.first[k], covered.last[k], covered.start[k], rows.columns,
                              rows.heights + std::ptrdiff_t{row - rows.first} * rows.columns);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(drawTriangles);

void drawHeights(const HeightTriangles& triangles, std::span<const std::uint32_t> indices, const HeightRows& rows) {
    HWY_DYNAMIC_DISPATCH(drawTriangles)(triangles, indices, rows);
}

}  // namespace render

#endif
