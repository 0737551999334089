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

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The occupied cells of a grid, numbered as they were found.
struct OccupiedCells {
    std::map<Cell, std::uint32_t> numbers;
    std::vector<std::uint32_t> numberOf;  ///< number of the cell of each particle
};

OccupiedCells occupiedCells(const std::vector<Vec3>& positions, double width) {
    OccupiedCells cells;
    cells.numberOf.reserve(positions.size());
    Cell last{};
    for (const Vec3& x : positions) {
        const Cell cell = {cellNumber(x.x(), width), cellNumber(x.y(), width), cellNumber(x.z(), width)};
        // Consecutive particles are usually in the same cell, which is then not searched for again.
        const bool isSame = cell == last && !cells.numberOf.empty();
        const auto next = static_cast<std::uint32_t>(cells.numbers.size());
        cells.numberOf.push_back(isSame ? cells.numberOf.back() : cells.numbers.try_emplace(cell, next).first->second);
        last = cell;
    }
    return cells;
}

/// Gives a group number to all cells that are connected to a cell through adjacent occupied cells.
void fillFrom(const Cell& cell, std::uint32_t group, const OccupiedCells& cells, std::vector<std::uint32_t>& groups) {
    std::vector<Cell> open = {cell};
    while (!open.empty()) {
        const Cell from = open.back();
        open.pop_back();
        for (int k = 0; k < 27; ++k) {
            const Cell near = {from[0] + k % 3 - 1, from[1] + k / 3 % 3 - 1, from[2] + k / 9 - 1};
            const auto found = cells.numbers.find(near);
            if (found == cells.numbers.end() || groups[found->second] != kNone) continue;
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

std::vector<MovingBox> movingBoxes(const FarGroups& groups, const std::vector<Vec3>& positions,
                                   const std::vector<Vec3>& motions) {
    std::vector<MovingBox> boxes;
    for (std::size_t group = 0; group < groups.count(); ++group) {
        const Vec3& leader = positions[groups.leaders[group]];
        boxes.push_back({{leader, leader}, motions[group]});
    }
    for (std::size_t p = 0; p < positions.size(); ++p) boxes[groups.of(p)].box.include({positions[p], positions[p]});
    return boxes;
}

/// Distance between two boxes, m; 0 if they overlap.
double distanceBetween(const BoundingBox& a, const BoundingBox& b) {
    const Vec3 gap = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0);
    return std::sqrt(squaredLength(gap));
}

}  // namespace

FarGroups findFarGroups(const std::vector<Vec3>& positions, double distance) {
    if (positions.size() < 2 || !(distance > 0.0)) return {};
    const BoundingBox extent =
        boundingBoxOf(positions.size(), [&](std::size_t p) -> const Vec3& { return positions[p]; });
    if ((extent.high - extent.low).maxCoeff() <= distance) return {};
    const OccupiedCells cells = occupiedCells(positions, distance * kRoundingMargin);
    std::vector<std::uint32_t> groupOfCell(cells.numbers.size(), kNone);
    std::uint32_t count = 0;
    for (const auto& [cell, number] : cells.numbers)
        if (groupOfCell[number] == kNone) fillFrom(cell, count++, cells, groupOfCell);
    if (count == 1) return {};

    FarGroups groups;
    groups.groupOf.reserve(positions.size());
    groups.leaders.assign(count, kNone);
    std::vector<std::size_t> sizes(count);
    for (std::uint32_t p = 0; p < positions.size(); ++p) {
        const std::uint32_t group = groupOfCell[cells.numberOf[p]];
        groups.groupOf.push_back(group);
        groups.leaders[group] = std::min(groups.leaders[group], p);
        ++sizes[group];
    }
    const auto largest = static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::swap(groups.leaders[0], groups.leaders[largest]);
    for (std::uint32_t& group : groups.groupOf) group = group == 0 ? largest : group == largest ? 0 : group;
    return groups;
}

bool stayApart(const FarGroups& groups, const std::vector<Vec3>& positions, const std::vector<Vec3>& motions,
               double distance) {
    for (const Vec3& motion : motions)
        if (!motion.allFinite()) return false;
    std::vector<MovingBox> boxes = movingBoxes(groups, positions, motions);
    const BoundingBox all = boundingBoxOf(positions.size(), [&](std::size_t p) -> const Vec3& { return positions[p]; });
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
