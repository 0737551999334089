// Particles in linked cells. The key of a cell consists of 21 bits of each of its three numbers along the axes, so
// cells that share a key are two million cells apart.
#include "engine/neighbors/linked_cells.h"

#include <algorithm>

#include "engine/core/random.h"
#include "engine/neighbors/cell_grid.h"

namespace engine {

LinkedCells::LinkedCells(double width, const std::vector<Vec3>& positions) : width_(width * kRoundingMargin) {
    links_.reserve(positions.size());
    for (const Vec3& position : positions) add(position);
}

void LinkedCells::add(const Vec3& position) {
    if (width_ == 0.0) return;
    links_.push_back({keyOf(cellOf(position)), kEnd});
    if (links_.size() <= first_.size()) {
        link(links_.size() - 1);
        return;
    }
    constexpr std::size_t kFewest = 64;
    first_.assign(std::max(kFewest, 2 * first_.size()), kEnd);
    for (std::size_t p = 0; p < links_.size(); ++p) link(p);
}

LinkedCells::Cell LinkedCells::cellOf(const Vec3& position) const {
    return {cellNumber(position.x(), width_), cellNumber(position.y(), width_), cellNumber(position.z(), width_)};
}

std::uint64_t LinkedCells::keyOf(const Cell& cell) {
    constexpr std::uint64_t kBits = 21;
    constexpr std::uint64_t kMask = (1U << kBits) - 1;
    const auto low = [&](std::int64_t index) { return static_cast<std::uint64_t>(index) & kMask; };
    return (low(cell.z) << (2 * kBits)) | (low(cell.y) << kBits) | low(cell.x);
}

std::size_t LinkedCells::chainOf(std::uint64_t key) const {
    return scatter(key) & (first_.size() - 1);
}

void LinkedCells::link(std::size_t p) {
    std::uint32_t& first = first_[chainOf(links_[p].key)];
    links_[p].next = first;
    first = static_cast<std::uint32_t>(p);
}

}  // namespace engine
