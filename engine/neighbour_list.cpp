// Two passes over the cells: count, then fill, so that the rows lie without gaps whoever fills them.
#include "engine/neighbour_list.h"

#include <algorithm>
#include <array>

#include "engine/parallel.h"

namespace engine {
namespace {

/// Calls visit(other place) for every other particle within reach of the one at a place, in the order of the grid.
/// Most candidates of a cell are out of reach, unpredictably so: they are sifted without branches first.
template <class Visit>
void forEachInReach(const NeighbourList& list, const Neighbourhood& around, std::uint32_t self, const Visit& visit) {
    constexpr std::uint32_t kSieve = 256;  // chosen: a kilobyte on the stack, longer than most rows of cells
    std::array<std::uint32_t, kSieve> within;
    const Vec3 position = list.sorted[self];
    const double reachSq = list.reach * list.reach;
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        for (std::uint32_t begin = range.begin; begin < range.end; begin += kSieve) {
            const std::uint32_t end = std::min(begin + kSieve, range.end);
            std::size_t found = 0;
            for (std::uint32_t other = begin; other < end; ++other) {
                within[found] = other;
                found += squaredLength(position - list.sorted[other]) < reachSq ? 1U : 0U;
            }
            for (std::size_t k = 0; k < found; ++k)
                if (within[k] != self) visit(within[k]);
        }
    }
}

template <class Body>
void forEachPlace(const CellGrid& grid, const Body& body) {
    constexpr std::size_t kGrain = 16;  // chosen: cells of a dense scene take some microseconds each
    inParallel(grid.cellCount(), kGrain, [&](std::size_t cell) {
        if (grid.start[cell] == grid.start[cell + 1]) return;
        const Neighbourhood around = neighbourhood(grid, static_cast<std::uint32_t>(cell));
        for (std::uint32_t self = grid.start[cell]; self < grid.start[cell + 1]; ++self) body(around, self);
    });
}

}  // namespace

void build(NeighbourList& list, const std::vector<Vec3>& positions, double cutoff, double skin) {
    list.reach = cutoff + skin;
    list.builtAt = positions;
    build(list.grid, positions, list.reach);
    list.order = list.grid.order;
    list.sorted.resize(positions.size());
    for (std::size_t place = 0; place < list.order.size(); ++place) list.sorted[place] = positions[list.order[place]];
    list.rowStart.assign(positions.size() + 1, 0);
    forEachPlace(list.grid, [&](const Neighbourhood& around, std::uint32_t self) {
        std::uint32_t found = 0;
        forEachInReach(list, around, self, [&](std::uint32_t) { ++found; });
        list.rowStart[self + 1] = found;
    });
    list.alone.resize(positions.size());
    for (std::size_t place = 0; place < list.order.size(); ++place)
        list.alone[list.order[place]] = list.rowStart[place + 1] == 0 ? 1 : 0;
    for (std::size_t place = 1; place < list.rowStart.size(); ++place) list.rowStart[place] += list.rowStart[place - 1];
    list.places.resize(list.rowStart.back());
    forEachPlace(list.grid, [&](const Neighbourhood& around, std::uint32_t self) {
        std::uint32_t* next = list.places.data() + list.rowStart[self];
        forEachInReach(list, around, self, [&](std::uint32_t other) { *next++ = other; });
    });
}

bool covers(const NeighbourList& list, const std::vector<Vec3>& positions, double cutoff) {
    if (positions.size() != list.builtAt.size() || cutoff > list.reach) return false;
    const double slack = 0.5 * (list.reach - cutoff);
    for (std::size_t p = 0; p < positions.size(); ++p)
        if (!(squaredLength(positions[p] - list.builtAt[p]) <= slack * slack)) return false;
    return true;
}

}  // namespace engine
