// Groups are the connected components of occupied cells in a coarse grid. Pairs of groups that may meet are found by
// sorting the boxes of the groups along one axis (sweep and prune).
#include "engine/neighbors/far_groups.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "engine/core/bounding_box.h"
#include "engine/neighbors/cell_grid.h"

namespace engine {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// The number of each occupied cell of a grid, in ascending order of the cells.
using OccupiedCells = std::map<Cell, std::uint32_t>;

Cell cellOf(const Vec3& x, double width) {
    return {cellNumber(x.x(), width), cellNumber(x.y(), width), cellNumber(x.z(), width)};
}

/// The cells with particles of any rank.
OccupiedCells occupiedCells(const Ranks& ranks, const std::vector<Vec3>& positions, double width) {
    OccupiedCells cells;
    Cell last{};
    for (const Vec3& x : positions) {
        const Cell cell = cellOf(x, width);
        // Consecutive particles are usually in the same cell, which is then not searched for again.
        if (cell != last || cells.empty()) cells.try_emplace(cell, 0);
        last = cell;
    }
    if (ranks.areMany()) {
        std::vector<double> numbers;  // which a double represents exactly
        for (const auto& [cell, number] : cells)
            for (const std::int64_t along : cell) numbers.push_back(static_cast<double>(along));
        numbers = ranks.gatherAll(numbers);
        for (std::size_t k = 0; k < numbers.size(); k += 3)
            cells.try_emplace({static_cast<std::int64_t>(numbers[k]), static_cast<std::int64_t>(numbers[k + 1]),
                               static_cast<std::int64_t>(numbers[k + 2])},
                              0);
    }
    std::uint32_t next = 0;
    for (auto& [cell, number] : cells) number = next++;
    return cells;
}

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Gives a group number to all cells that are connected to a cell through adjacent occupied cells.
void fillFrom(const Cell& cell, std::uint32_t group, const OccupiedCells& cells, std::vector<std::uint32_t>& groups) {
    std::vector<Cell> open = {cell};
    while (!open.empty()) {
        const Cell from = open.back();
        open.pop_back();
        for (int k = 0; k < 27; ++k) {
            const Cell near = {from[0] + k % 3 - 1, from[1] + k / 3 % 3 - 1, from[2] + k / 9 - 1};
            const auto found = cells.find(near);
            if (found == cells.end() || groups[found->second] != kNone) continue;
            groups[found->second] = group;
            open.push_back(near);
        }
    }
}

/// A group's bounding box and its displacement, m.
struct MovingBox {
    BoundingBox box;
    Vec3 motion;
};

std::vector<MovingBox> movingBoxes(const Ranks& ranks, const FarGroups& groups, const std::vector<Vec3>& positions,
                                   const std::vector<Vec3>& motions) {
    std::vector<MovingBox> boxes;
    for (const Vec3& motion : motions) boxes.push_back({BoundingBox::empty(), motion});
    for (std::size_t p = 0; p < positions.size(); ++p) boxes[groups.of(p)].box.include({positions[p], positions[p]});
    if (!ranks.areMany()) return boxes;
    std::vector<double> bounds;  // the lower ones with a minus, for maximize()
    for (const MovingBox& of : boxes)
        for (int axis = 0; axis < 3; ++axis) bounds.insert(bounds.end(), {-of.box.low[axis], of.box.high[axis]});
    ranks.maximize(bounds);
    const double* next = bounds.data();
    for (MovingBox& of : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            of.box.low[axis] = -*next++;
            of.box.high[axis] = *next++;
        }
    return boxes;
}

/// Distance between two boxes, m; 0 if they overlap.
double distanceBetween(const BoundingBox& a, const BoundingBox& b) {
    const Vec3 gap = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0);
    return std::sqrt(squaredLength(gap));
}

/// Of the particles of the ranks that may lead a group, keeps the one with the lowest id.
/// @param leaders  particle index on this rank for each group, or kElsewhere
void keepLowestIds(const Ranks& ranks, const std::vector<std::uint32_t>& ids, std::vector<std::uint32_t>& leaders) {
    if (!ranks.areMany()) return;
    std::vector<double> lowest;  // with a minus, for maximize()
    for (const std::uint32_t leader : leaders)
        lowest.push_back(leader == FarGroups::kElsewhere ? -static_cast<double>(FarGroups::kElsewhere)
                                                         : -static_cast<double>(ids[leader]));
    const std::vector<double> own = lowest;
    ranks.maximize(lowest);
    for (std::size_t group = 0; group < leaders.size(); ++group)
        if (own[group] != lowest[group]) leaders[group] = FarGroups::kElsewhere;
}

}  // namespace

FarGroups findFarGroups(const Ranks& ranks, const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& ids,
                        double distance) {
    const BoundingBox extent =
        overRanks(ranks, boundingBoxOf(positions.size(), [&](std::size_t p) -> const Vec3& { return positions[p]; }));
    if (!(distance > 0.0) || (extent.high - extent.low).maxCoeff() <= distance) return {};
    const double width = distance * kRoundingMargin;
    const OccupiedCells cells = occupiedCells(ranks, positions, width);
    std::vector<std::uint32_t> groupOfCell(cells.size(), kNone);
    std::uint32_t count = 0;
    for (const auto& [cell, number] : cells)
        if (groupOfCell[number] == kNone) fillFrom(cell, count++, cells, groupOfCell);
    if (count < 2) return {};

    FarGroups groups;
    groups.groupOf.reserve(positions.size());
    groups.leaders.assign(count, FarGroups::kElsewhere);
    std::vector<std::int64_t> sizes(count);
    Cell last{};
    std::uint32_t group = kNone;
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        const Cell cell = cellOf(positions[p], width);
        if (cell != last || group == kNone) group = groupOfCell[cells.at(cell)];
        last = cell;
        groups.groupOf.push_back(group);
        groups.leaders[group] = std::min(groups.leaders[group], p);
        ++sizes[group];
    }
    ranks.sum(sizes);
    keepLowestIds(ranks, ids, groups.leaders);
    const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::swap(groups.leaders[0], groups.leaders[largest]);
    for (std::uint32_t& of : groups.groupOf) of = of == 0 ? largest : of == largest ? 0 : of;
    return groups;
}

bool stayApart(const Ranks& ranks, const FarGroups& groups, const std::vector<Vec3>& positions,
               const std::vector<Vec3>& motions, double distance) {
    for (const Vec3& motion : motions)
        if (!motion.allFinite()) return false;
    std::vector<MovingBox> boxes = movingBoxes(ranks, groups, positions, motions);
    BoundingBox all = BoundingBox::empty();
    for (const MovingBox& of : boxes) all.include(of.box);
    int axis = 0;  // along which the groups are spread most
    (all.high - all.low).maxCoeff(&axis);
    std::sort(boxes.begin(), boxes.end(),
              [&](const MovingBox& a, const MovingBox& b) { return a.box.low[axis] < b.box.low[axis]; });
    const BoundingBox spread = boundingBoxOf(motions.size(), [&](std::size_t g) -> const Vec3& { return motions[g]; });
    const double reach = distance + (spread.high - spread.low)[axis];
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a + 1; b < boxes.size(); ++b) {
            if (boxes[b].box.low[axis] - boxes[a].box.high[axis] > reach) break;
            const double approach = std::sqrt(squaredLength(boxes[a].motion - boxes[b].motion));
            if (!(distanceBetween(boxes[a].box, boxes[b].box) > distance + approach)) return false;
        }
    return true;
}

}  // namespace engine
