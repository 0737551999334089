// Rows are found chunk by chunk of cells, then put together in order, whoever found them.
#include "engine/neighbour_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/parallel.h"

namespace engine {
namespace {

constexpr std::size_t kCellsPerChunk = 16;  // chosen: cells of a dense scene take some microseconds each

/// The rows of the particles of some cells, one after the other.
struct Chunk {
    std::size_t firstCell = 0;
    std::size_t endCell = 0;
};

Chunk chunkOf(const CellGrid& grid, std::size_t number) {
    return {number * kCellsPerChunk, std::min((number + 1) * kCellsPerChunk, grid.cellCount())};
}

std::size_t candidateCount(const Neighbourhood& around) {
    std::size_t sum = 0;
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        sum += range.end - range.begin;
    }
    return sum;
}

/// Fills the chunk's rows; rowStart[place + 1] becomes the length of the row.
void search(NeighbourList& list, const Chunk& chunk, std::vector<std::uint32_t>& rows) {
    const CellGrid& grid = list.grid;
    std::size_t used = 0;
    for (std::size_t cell = chunk.firstCell; cell < chunk.endCell; ++cell) {
        if (grid.start[cell] == grid.start[cell + 1]) continue;
        const Neighbourhood around = neighbourhood(grid, static_cast<std::uint32_t>(cell));
        const std::size_t room = candidateCount(around) + kSearchOverhang;
        for (std::uint32_t self = grid.start[cell]; self < grid.start[cell + 1]; ++self) {
            if (rows.size() < used + room) rows.resize(2 * (used + room));
            std::uint32_t* const row = rows.data() + used;
            const std::uint32_t* const end = findInReach(list.candidates, around, self, list.reach * list.reach, row);
            list.rowStart[self + 1] = static_cast<std::uint32_t>(end - row);
            used += static_cast<std::size_t>(end - row);
        }
    }
    rows.resize(used);
}

void sortByPlace(NeighbourList& list, const std::vector<Vec3>& positions) {
    list.order = list.grid.order;
    const std::size_t count = list.order.size();
    list.placeOf.resize(count);
    list.candidates.x.resize(count + kSearchOverhang);
    list.candidates.y.resize(count + kSearchOverhang);
    list.candidates.z.resize(count + kSearchOverhang);
    inParallel(count, kParticleGrain, [&](std::size_t place) {
        list.placeOf[list.order[place]] = static_cast<std::uint32_t>(place);
        const Vec3& position = positions[list.order[place]];
        list.candidates.x[place] = position.x();
        list.candidates.y[place] = position.y();
        list.candidates.z[place] = position.z();
    });
}

}  // namespace

void build(NeighbourList& list, const std::vector<Vec3>& positions, double cutoff, double skin) {
    list.reach = cutoff + skin;
    list.builtAt = positions;
    build(list.grid, positions, list.reach);
    sortByPlace(list, positions);
    list.rowStart.assign(positions.size() + 1, 0);
    const std::size_t chunks = (list.grid.cellCount() + kCellsPerChunk - 1) / kCellsPerChunk;
    list.found.resize(chunks);
    inParallel(chunks, 1, [&](std::size_t c) { search(list, chunkOf(list.grid, c), list.found[c]); });
    for (std::size_t place = 1; place < list.rowStart.size(); ++place) list.rowStart[place] += list.rowStart[place - 1];
    list.places.resize(list.rowStart.back());
    inParallel(chunks, 1, [&](std::size_t c) {
        const std::uint32_t first = list.rowStart[list.grid.start[chunkOf(list.grid, c).firstCell]];
        std::copy(list.found[c].begin(), list.found[c].end(), list.places.begin() + first);
        list.found[c].clear();
    });
}

bool covers(const NeighbourList& list, const std::vector<Vec3>& positions, double cutoff) {
    if (positions.size() != list.builtAt.size() || cutoff > list.reach) return false;
    const double slack = 0.5 * (list.reach - cutoff);
    return largestOver(positions.size(), [&](std::size_t p) {
               const double moveSq = squaredLength(positions[p] - list.builtAt[p]);
               return std::isnan(moveSq) ? std::numeric_limits<double>::infinity() : moveSq;
           }) <= slack * slack;
}

}  // namespace engine
