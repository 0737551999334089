// Rows are found block by block, and laid out while they are in the cache of whoever found them. The lanes of a cluster
// wait for its longest row: particles with rows of like length are slotted side by side.
#include "engine/neighbors/neighbor_list.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "engine/core/bounding_box.h"
#include "engine/core/parallel.h"
#include "engine/neighbors/row_layout.h"

namespace engine {
namespace {

/// The sortedIndices and the lane slots of a block.
CellRange rangeOf(const NeighborList& list, std::size_t block) {
    return {static_cast<std::uint32_t>(block * kSlotsPerBlock),
            static_cast<std::uint32_t>(std::min((block + 1) * kSlotsPerBlock, list.count()))};
}

/// Which laneSlot of a block each of its rows gets, the longest first: a counting sort, in which all that are far
/// shorter are one.
std::array<std::uint32_t, kSlotsPerBlock> ranksOf(const std::uint32_t* lengths, std::uint32_t count) {
    constexpr std::uint32_t kLengths = 128;
    const std::uint32_t longest = *std::max_element(lengths, lengths + count);
    const std::uint32_t last = std::min(longest - *std::min_element(lengths, lengths + count), kLengths - 1);
    const auto shortness = [&](std::uint32_t at) { return std::min(longest - lengths[at], last); };
    std::array<std::uint32_t, kLengths + 1> next = {};
    for (std::uint32_t at = 0; at < count; ++at) ++next[shortness(at) + 1];
    for (std::uint32_t length = 0; length < last; ++length) next[length + 1] += next[length];
    std::array<std::uint32_t, kSlotsPerBlock> ranks = {};
    for (std::uint32_t at = 0; at < count; ++at) ranks[at] = next[shortness(at)]++;
    return ranks;
}

/// Rows of a block as they are found, in the order of sortedIndices. Kept by each thread.
struct FoundBlock {
    Surroundings surroundings;
    FoundRows rows;
    std::array<std::uint32_t, kSlotsPerBlock> lengths;
    CellRange around;  ///< from the first sortedIndex to the last that may occur
};

/// What is around some cells is looked at once for so many particles, if they are no further apart than float sees
/// well. Measured with `globular bench --filter list`: a quarter less time for powder than cell by cell; 6 to 32 are
/// alike.
constexpr std::uint32_t kRunParticles = 12;
constexpr auto kRunCells = static_cast<std::uint32_t>(kClearSight);

void search(const NeighborList& list, const CellRange& range, FoundBlock& found) {
    found.rows.used = 0;
    found.around = range;
    const CellGrid& grid = list.scratch.grid;
    std::uint32_t cell = cellOfSortedIndex(grid, range.begin);
    for (std::uint32_t sortedIndex = range.begin; sortedIndex < range.end;) {
        while (grid.start[cell + 1] <= sortedIndex) ++cell;
        const CellRun run = runFrom(grid, cell, kRunParticles, kRunCells);
        const CellRange ownIndices{sortedIndex, std::min(grid.start[run.last + 1], range.end)};
        const Neighborhood around = neighborhood(grid, run);
        for (int r = 0; r < around.count; ++r) {
            found.around.begin = std::min(found.around.begin, around.ranges[static_cast<std::size_t>(r)].begin);
            found.around.end = std::max(found.around.end, around.ranges[static_cast<std::size_t>(r)].end);
        }
        findInReach(list.scratch.candidates, around, ownIndices, list.reach, found.surroundings, found.rows,
                    &found.lengths[sortedIndex - range.begin]);
        sortedIndex = ownIndices.end;
    }
}

/// Rows of a block by laneSlot.
using SlottedRows = std::array<const std::uint32_t*, kSlotsPerBlock>;

/// Seats the particles of a block.
SlottedRows assignLaneSlots(NeighborList& list, const CellRange& range, const FoundBlock& found) {
    SlottedRows rows;
    const std::uint32_t* next = found.rows.sortedIndices.data();
    const std::uint32_t count = range.end - range.begin;
    const auto ranks = ranksOf(found.lengths.data(), count);
    for (std::uint32_t of = 0; of < count; ++of) {
        const std::uint32_t sortedIndex = range.begin + of;
        const std::uint32_t laneSlot = range.begin + ranks[of];
        rows[ranks[of]] = next;
        next += found.lengths[of] + kRowPadding;
        list.rows.length[laneSlot] = found.lengths[of];
        list.rows.ownIndices[laneSlot] = static_cast<std::int32_t>(sortedIndex);
    }
    // Where nobody is, the last one's padding.
    std::fill(rows.begin() + count, rows.end(), next - kRowPadding);
    return rows;
}

/// Room for so many entries, and not much more: rows of a block change little from list to list.
template <class Entry>
void makeRoom(std::vector<Entry>& sortedIndices, std::size_t entries) {
    if (sortedIndices.capacity() < entries) {
        sortedIndices = std::vector<Entry>();
        sortedIndices.reserve(entries + entries / 8);
    }
    sortedIndices.resize(entries);
}

/// Lays out the rows of the clusters of a block. Shape: length: of each laneSlot's row.
template <class Entry>
void layOut(const SlottedRows& slotted, const std::uint32_t* length, std::size_t clusters, RowBlock& block) {
    std::vector<Entry>& entries = entriesOf<Entry>(block);
    makeRoom(entries, (block.start[clusters] + 1) * kClusterSize);
    std::fill(entries.end() - kClusterSize, entries.end(), Entry(0));
    for (std::size_t cluster = 0; cluster < clusters; ++cluster) {
        ClusterRows rows;
        std::copy_n(&slotted[cluster * kClusterSize], kClusterSize, rows.row.begin());
        std::copy_n(length + cluster * kClusterSize, kClusterSize, rows.length.begin());
        rows.longest = block.start[cluster + 1] - block.start[cluster];
        interleave(rows, block.base, &entries[block.start[cluster] * kClusterSize]);
    }
}

/// Finds the rows of a block and lays them out.
void fill(NeighborList& list, std::size_t number) {
    thread_local FoundBlock found;
    const CellRange range = rangeOf(list, number);
    search(list, range, found);
    const CellGrid& grid = list.scratch.grid;
    list.fronts[number] = frontOf(grid, cellOfSortedIndex(grid, range.begin), cellOfSortedIndex(grid, range.end - 1));
    const SlottedRows slotted = assignLaneSlots(list, range, found);
    RowBlock& block = list.rows.blocks[number];
    const std::uint32_t* const length = &list.rows.length[range.begin];
    const std::size_t clusters = (range.end - range.begin + kClusterSize - 1) / kClusterSize;
    block.start[0] = 0;
    for (std::size_t cluster = 0; cluster < kClustersPerBlock; ++cluster) {
        const std::uint32_t* const first = length + cluster * kClusterSize;
        block.start[cluster + 1] =
            block.start[cluster] + (cluster < clusters ? *std::max_element(first, first + kClusterSize) : 0);
    }
    block.base = found.around.begin;
    constexpr std::uint32_t kNarrow = std::numeric_limits<std::uint16_t>::max();
    if (found.around.end - 1 - block.base <= kNarrow) {
        block.entries32 = std::vector<std::int32_t>();
        layOut<std::uint16_t>(slotted, length, clusters, block);
    } else {
        block.entries16 = std::vector<std::uint16_t>();
        layOut<std::int32_t>(slotted, length, clusters, block);
    }
}

void sortByCell(NeighborList& list, const std::vector<Vec3>& positions) {
    list.order.swap(list.scratch.grid.order);
    const std::size_t count = list.order.size();
    list.sortedIndexOf.resize(count);
    Candidates& candidates = list.scratch.candidates;
    for (std::vector<double>* of : {&candidates.x, &candidates.y, &candidates.z}) of->resize(count + kSearchOverhang);
    inParallel(count, kParticleGrain, [&](std::size_t sortedIndex) {
        const std::uint32_t p = list.order[sortedIndex];
        list.sortedIndexOf[p] = static_cast<std::uint32_t>(sortedIndex);
        candidates.x[sortedIndex] = positions[p].x();
        candidates.y[sortedIndex] = positions[p].y();
        candidates.z[sortedIndex] = positions[p].z();
    });
}

/// Whether a list is of so many particles and reaches so far (m). One that is forgotten has its order still.
bool isOf(const NeighborList& list, std::size_t count, double cutoff) {
    return count == list.builtAt.size() && count == list.count() && cutoff <= list.reach;
}

/// How far each particle may go, m.
double slackOf(const NeighborList& list, double cutoff) {
    return 0.5 * (list.reach - cutoff);
}

template <class... Vectors>
std::size_t bytesHeld(const Vectors&... vectors) {
    return (std::size_t{0} + ... + (vectors.capacity() * sizeof(vectors[0])));
}

}  // namespace

void build(NeighborList& list, const std::vector<Vec3>& positions, double cutoff, double skin) {
    list.reach = cutoff + skin;
    copy(positions, list.builtAt);
    build(list.scratch.grid, positions, list.reach);
    sortByCell(list, positions);
    const std::size_t clusters = (list.count() + kClusterSize - 1) / kClusterSize;
    const std::size_t blocks = (clusters + kClustersPerBlock - 1) / kClustersPerBlock;
    list.rows.ownIndices.assign(clusters * kClusterSize, static_cast<std::int32_t>(list.count()) - 1);
    list.rows.length.assign(clusters * kClusterSize, 0);
    list.rows.blocks.resize(blocks);
    list.fronts.resize(blocks);
    inParallel(blocks, 1, [&](std::size_t block) { fill(list, block); });
    list.entryCount = std::accumulate(list.rows.length.begin(), list.rows.length.end(), std::size_t{0});
}

std::size_t NeighborList::laneSlotOf(std::size_t p) const {
    // Few ask: written down for all, lane slots would take longer than to be looked for.
    const std::uint32_t sortedIndex = sortedIndexOf[p];
    std::size_t laneSlot = NeighborRows::blockOf(sortedIndex) * kSlotsPerBlock;
    while (rows.ownIndices.at(laneSlot) != static_cast<std::int32_t>(sortedIndex)) ++laneSlot;
    return laneSlot;
}

bool coversWithin(const NeighborList& list, const BoundingBox& displacements, std::size_t count, double cutoff) {
    constexpr double kMargin = 1.0 - 1e-9;  // for the roundings of lengths and their squares, in either look
    return isOf(list, count, cutoff) && displacements.halfDiagonal() <= kMargin * slackOf(list, cutoff);
}

bool covers(const NeighborList& list, const std::vector<Vec3>& positions, double cutoff) {
    if (!isOf(list, positions.size(), cutoff)) return false;
    if (positions.empty()) return true;
    const double slack = slackOf(list, cutoff);
    const auto way = [&](std::size_t p) -> Vec3 { return positions[p] - list.builtAt[p]; };
    if (areWithin(slack, Vec3::Zero(), positions.size(), way)) return true;  // mostly, and soon known
    // Where some have parted by more than two slacks, there is no way that all are near to. The youngest come last, and
    // are the liveliest.
    const std::size_t some = std::min(positions.size(), kSumChunk);
    const BoundingBox young = boundingBoxOf(some, [&](std::size_t p) { return way(positions.size() - some + p); });
    constexpr double kMargin = 1.0 + 1e-6;  // far above what the look at each of them rounds
    if ((young.high - young.low).maxCoeff() > 2.0 * kMargin * slack) return false;
    return areWithin(slack, boundingBoxOf(positions.size(), way).middle(), positions.size(), way);
}

std::size_t roomOf(const NeighborRows& rows) {
    std::size_t sum = 0;
    for (const RowBlock& block : rows.blocks)
        sum += block.uses32Bits() ? block.entries32.capacity() : block.entries16.capacity();
    return sum;
}

std::size_t bytesOf(const NeighborRows& rows) {
    std::size_t sum = bytesHeld(rows.ownIndices, rows.length, rows.blocks);
    for (const RowBlock& block : rows.blocks) sum += block.bytes();
    return sum;
}

std::size_t bytesOf(const NeighborList& list) {
    const BuildScratch& scratch = list.scratch;
    return bytesOf(list.rows) + bytesHeld(list.order, list.sortedIndexOf, list.fronts, list.builtAt, scratch.grid.start,
                                          scratch.grid.order, scratch.grid.cellOf, scratch.candidates.x,
                                          scratch.candidates.y, scratch.candidates.z);
}

}  // namespace engine
