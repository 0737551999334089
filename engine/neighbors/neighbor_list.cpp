// Builds neighbor lists. Positions are sorted into a cell grid; then each thread finds the rows of a block of particles
// and interleaves them while they are in its cache.
#include "engine/neighbors/neighbor_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/bounding_box.h"
#include "engine/core/parallel.h"

namespace engine {
namespace {

/// The range of sorted indices of a block of particles, which is also the range of the block's lane slots.
CellRange rangeOf(const NeighborList& list, std::size_t block) {
    return {static_cast<std::uint32_t>(block * kSlotsPerBlock),
            static_cast<std::uint32_t>(std::min((block + 1) * kSlotsPerBlock, list.count()))};
}

/// Sorts the rows of a block by length, the longest first, and returns the lane slot in the block that each row gets. A
/// counting sort, in which all rows that are shorter than the longest by kLengths or more count as equally long.
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

/// The rows of a block in the order of sorted indices, in which they are found. Work memory of each thread.
struct FoundBlock {
    SearchScratch scratch;
    FoundRows rows;
    std::array<std::uint32_t, kSlotsPerBlock> lengths;
    FoundRows parts;                         ///< the neighbors in each class of sizes, before they are joined to rows
    std::vector<std::uint32_t> partLengths;  ///< length of each particle's part in the first class, then in the next
    std::vector<CellRange> ranges;
};

/// Adjacent cells are searched together as long as they contain at most kRunParticles particles and are not longer than
/// the float coordinates of the search can resolve. Measured with `globular bench --filter list`: a quarter less time
/// for powder than cell by cell; limits of 6 to 32 particles take the same time.
constexpr std::uint32_t kRunParticles = 12;
constexpr auto kRunCells = static_cast<std::uint32_t>(kFloatRange);

/// Largest distance (m) at which particles of two classes are listed as neighbors.
double reachOf(const NeighborList& list, const SizeClass& one, const SizeClass& other) {
    return 0.5 * (one.relativeRadius + other.relativeRadius) * list.cutoff + list.skin;
}

/// The box of all places within a distance (m) of some particles, given by their range of sorted indices.
BoundingBox boxAround(const Candidates& candidates, const CellRange& own, double distance) {
    const auto positionOf = [&](std::uint32_t sortedIndex) {
        return Vec3(candidates.x[sortedIndex], candidates.y[sortedIndex], candidates.z[sortedIndex]);
    };
    BoundingBox box{positionOf(own.begin), positionOf(own.begin)};
    for (std::uint32_t index = own.begin + 1; index < own.end; ++index)
        box.include({positionOf(index), positionOf(index)});
    const Vec3 margin = Vec3::Constant(distance * kRoundingMargin);
    return {box.low - margin, box.high + margin};
}

/// Finds the neighbors of some particles of one class, which are in the cells of a run, in the whole of that class.
void searchOwnClass(const NeighborList& list, const SizeClass& ownClass, const CellRun& run, const CellRange& own,
                    SearchScratch& scratch, FoundRows& rows, std::uint32_t* lengths) {
    Neighborhood around = neighborhood(ownClass.grid, run);
    for (CellRange& range : around.used())
        range = {range.begin + ownClass.sorted.begin, range.end + ownClass.sorted.begin};
    findInReach(list.scratch.candidates, around.used(), own, 0, reachOf(list, ownClass, ownClass), scratch, rows,
                lengths);
}

/// Finds the neighbors of these particles in another class; each row has them in the order of their particle indices.
void searchOtherClass(const NeighborList& list, const SizeClass& ownClass, const SizeClass& other, const CellRange& own,
                      FoundBlock& found, std::uint32_t* lengths) {
    const double reach = reachOf(list, ownClass, other);
    const Candidates& candidates = list.scratch.candidates;
    found.ranges.assign(1, own);
    appendRanges(other.grid, boxAround(candidates, own, reach), found.ranges);
    const std::uint32_t ownCount = own.end - own.begin;
    if (found.ranges.size() == 1) {
        std::fill_n(lengths, ownCount, 0);
        return;
    }
    for (CellRange& range : std::span(found.ranges).subspan(1))
        range = {range.begin + other.sorted.begin, range.end + other.sorted.begin};
    std::size_t begin = found.parts.used;
    findInReach(candidates, found.ranges, own, ownCount, reach, found.scratch, found.parts, lengths);
    // The order of the ranges depends on the extent of the other grid, of which a rank sees only a part.
    const auto byParticle = [&](std::uint32_t one, std::uint32_t another) {
        return list.order[one] < list.order[another];
    };
    for (const std::uint32_t length : std::span(lengths, ownCount)) {
        const auto first = found.parts.sortedIndices.begin() + static_cast<std::ptrdiff_t>(begin);
        std::sort(first, first + length, byParticle);
        begin += length;
    }
}

/// Appends the rows of `count` particles, which have been found in parts.
void joinParts(FoundBlock& found, std::size_t count, std::uint32_t* lengths) {
    const std::size_t classes = found.partLengths.size() / count;
    std::vector<const std::uint32_t*> next(classes);  // where the part of the next row begins, for each class
    const std::uint32_t* part = found.parts.sortedIndices.data();
    for (std::size_t c = 0; c < classes; ++c) {
        next[c] = part;
        part = std::accumulate(&found.partLengths[c * count], &found.partLengths[c * count] + count, part);
    }
    FoundRows& rows = found.rows;
    if (rows.sortedIndices.size() < rows.used + found.parts.used)
        rows.sortedIndices.resize(rows.used + rows.used / 2 + found.parts.used);
    for (std::size_t k = 0; k < count; ++k) {
        lengths[k] = 0;
        for (std::size_t c = 0; c < classes; ++c) {
            const std::uint32_t length = found.partLengths[c * count + k];
            std::copy_n(next[c], length, rows.sortedIndices.data() + rows.used);
            next[c] += length;
            rows.used += length;
            lengths[k] += length;
        }
    }
}

/// Finds the neighbors of some particles of one class, which are in the cells of a run, class by class.
void searchAllClasses(const NeighborList& list, const SizeClass& ownClass, const CellRun& run, const CellRange& own,
                      FoundBlock& found, std::uint32_t* lengths) {
    const std::size_t count = own.end - own.begin;
    found.parts.used = 0;
    found.partLengths.resize(count * list.scratch.classes.size());
    std::uint32_t* partLengths = found.partLengths.data();
    for (const SizeClass& other : list.scratch.classes) {
        if (&other == &ownClass)
            searchOwnClass(list, ownClass, run, own, found.scratch, found.parts, partLengths);
        else
            searchOtherClass(list, ownClass, other, own, found, partLengths);
        partLengths += count;
    }
    joinParts(found, count, lengths);
}

/// Finds the neighbors of the particles in a range of sorted indices, which are in one class.
void search(const NeighborList& list, const SizeClass& ownClass, const CellRange& range, FoundBlock& found,
            std::uint32_t* lengths) {
    const CellGrid& grid = ownClass.grid;
    const std::uint32_t base = ownClass.sorted.begin;
    std::uint32_t cell = cellOfSortedIndex(grid, range.begin - base);
    for (std::uint32_t first = range.begin; first < range.end;) {
        while (grid.start[cell + 1] + base <= first) ++cell;
        const CellRun run = runFrom(grid, cell, kRunParticles, kRunCells);
        const CellRange own{first, std::min(grid.start[run.last + 1] + base, range.end)};
        std::uint32_t* const ownLengths = lengths + (first - range.begin);
        if (list.scratch.classes.size() == 1)
            searchOwnClass(list, ownClass, run, own, found.scratch, found.rows, ownLengths);
        else
            searchAllClasses(list, ownClass, run, own, found, ownLengths);
        first = own.end;
    }
}

/// Finds the neighbors of the particles in a range of sorted indices.
void search(const NeighborList& list, const CellRange& range, FoundBlock& found) {
    found.rows.used = 0;
    for (const SizeClass& sizeClass : list.scratch.classes) {
        const CellRange part{std::max(range.begin, sizeClass.sorted.begin), std::min(range.end, sizeClass.sorted.end)};
        if (part.begin < part.end) search(list, sizeClass, part, found, &found.lengths[part.begin - range.begin]);
    }
}

/// The lengths of the rows of a block: as found, but 0 for ghosts, whose rows are not used.
std::array<std::uint32_t, kSlotsPerBlock> lengthsOfRows(const NeighborList& list, const CellRange& range,
                                                        const FoundBlock& found) {
    std::array<std::uint32_t, kSlotsPerBlock> lengths = found.lengths;
    const std::span<const std::uint8_t> isGhost = list.scratch.isGhost;
    if (!isGhost.empty())
        for (std::uint32_t k = range.begin; k < range.end; ++k)
            if (isGhost[list.order[k]] != 0) lengths[k - range.begin] = 0;
    return lengths;
}

/// Assigns the particles of a block to its lane slots. Returns the found row of each slot; nullptr in empty slots.
std::array<const std::uint32_t*, kSlotsPerBlock> assignLaneSlots(NeighborList& list, const CellRange& range,
                                                                 const FoundBlock& found) {
    std::array<const std::uint32_t*, kSlotsPerBlock> rows = {};
    const std::uint32_t* next = found.rows.sortedIndices.data();
    const std::uint32_t count = range.end - range.begin;
    const auto lengths = lengthsOfRows(list, range, found);
    const auto ranks = ranksOf(lengths.data(), count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t laneSlot = range.begin + ranks[k];
        rows[ranks[k]] = next;
        next += found.lengths[k];
        list.rows.length[laneSlot] = lengths[k];
        list.rows.ownIndices[laneSlot] = static_cast<std::int32_t>(range.begin + k);
    }
    return rows;
}

/// Resizes the entries of a block, with little spare capacity, because the rows of a block change little from list to
/// list.
void makeRoom(std::vector<std::int32_t>& entries, std::size_t count) {
    if (entries.capacity() < count) {
        entries = std::vector<std::int32_t>();
        entries.reserve(count + count / 8);
    }
    entries.resize(count);
}

/// Interleaves the found rows of a cluster and pads them to the length of the longest. Four lanes are written together
/// as far as the shortest of their rows goes, because their entries lie side by side in memory.
/// @param rows     found row of each lane
/// @param lengths  of these rows
/// @param padding  entry that follows the row of each lane
void interleave(const std::uint32_t* const* rows, const std::uint32_t* lengths, std::uint32_t longest,
                const std::int32_t* padding, std::int32_t* entries) {
    for (std::size_t first = 0; first < kClusterSize; first += 4) {
        const std::array row = {rows[first], rows[first + 1], rows[first + 2], rows[first + 3]};
        const std::uint32_t common = *std::min_element(lengths + first, lengths + first + 4);
        for (std::uint32_t k = 0; k < common; ++k) {
            const std::array four = {row[0][k], row[1][k], row[2][k], row[3][k]};
            std::copy(four.begin(), four.end(), entries + k * kClusterSize + first);
        }
        for (std::size_t lane = first; lane < first + 4; ++lane)
            for (std::uint32_t k = common; k < longest; ++k)
                entries[k * kClusterSize + lane] =
                    k < lengths[lane] ? static_cast<std::int32_t>(rows[lane][k]) : padding[lane];
    }
}

/// Finds the neighbor rows of a block of particles and interleaves them while they are in the thread's cache.
void fill(NeighborList& list, std::size_t number) {
    thread_local FoundBlock found;
    const CellRange range = rangeOf(list, number);
    search(list, range, found);
    const auto rows = assignLaneSlots(list, range, found);
    RowBlock& block = list.rows.blocks[number];
    const std::uint32_t* const lengths = &list.rows.length[range.begin];
    const std::size_t clusters = (range.end - range.begin + kClusterSize - 1) / kClusterSize;
    for (std::size_t cluster = 0; cluster < kClustersPerBlock; ++cluster) {
        const std::uint32_t* const first = lengths + cluster * kClusterSize;
        block.start[cluster + 1] =
            block.start[cluster] + (cluster < clusters ? *std::max_element(first, first + kClusterSize) : 0);
    }
    makeRoom(block.entries, (block.start[clusters] + 1) * kClusterSize);
    // Kernels may read one group of entries beyond the last.
    std::fill(block.entries.end() - kClusterSize, block.entries.end(), 0);
    for (std::size_t cluster = 0; cluster < clusters; ++cluster) {
        const std::size_t slot = cluster * kClusterSize;
        interleave(&rows[slot], lengths + slot, block.start[cluster + 1] - block.start[cluster],
                   &list.rows.ownIndices[range.begin + slot], &block.entries[block.start[cluster] * kClusterSize]);
    }
}

/// Puts the particles into the order of the cell grids and copies the positions in this order, for the search.
void sortByCell(NeighborList& list, const std::vector<Vec3>& positions) {
    std::vector<SizeClass>& classes = list.scratch.classes;
    if (classes.size() == 1 && classes[0].members.empty()) {
        list.order.swap(classes[0].grid.order);
    } else {
        list.order.clear();
        for (const SizeClass& sizeClass : classes)
            for (const std::uint32_t member : sizeClass.grid.order) list.order.push_back(sizeClass.members[member]);
    }
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

template <class... Vectors>
std::size_t bytesHeld(const Vectors&... vectors) {
    return (std::size_t{0} + ... + (vectors.capacity() * sizeof(vectors[0])));
}

}  // namespace

void build(NeighborList& list, const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff,
           double skin) {
    build(list, positions, radii, cutoff, skin, sizesOf(Ranks::alone(), radii), {});
}

void build(NeighborList& list, const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff,
           double skin, const SizeTable& sizes, std::span<const std::uint8_t> isGhost) {
    list.cutoff = cutoff;
    list.skin = skin;
    list.scratch.isGhost = isGhost;
    copy(positions, list.builtAt);
    divideBySize(sizes, radii, positions.size(), list.scratch.classes);
    for (SizeClass& sizeClass : list.scratch.classes)
        buildGrid(sizeClass, positions, reachOf(list, sizeClass, sizeClass));
    sortByCell(list, positions);
    const std::size_t clusters = (list.count() + kClusterSize - 1) / kClusterSize;
    const std::size_t blocks = (clusters + kClustersPerBlock - 1) / kClustersPerBlock;
    list.rows.ownIndices.assign(clusters * kClusterSize, static_cast<std::int32_t>(list.count()) - 1);
    list.rows.length.assign(clusters * kClusterSize, 0);
    list.rows.blocks.resize(blocks);
    inParallel(blocks, 1, [&](std::size_t block) { fill(list, block); });
    list.entryCount = std::accumulate(list.rows.length.begin(), list.rows.length.end(), std::size_t{0});
}

void discard(NeighborList& list) {
    list.order.clear();
    list.sortedIndexOf.clear();
    list.builtAt.clear();
    list.rows.ownIndices.clear();
    list.rows.length.clear();
    list.rows.blocks.clear();
    list.entryCount = 0;
}

std::size_t NeighborList::laneSlotOf(std::size_t p) const {
    // This is called for few particles. Storing the lane slots of all particles would take longer than these searches.
    const std::uint32_t sortedIndex = sortedIndexOf[p];
    std::size_t laneSlot = NeighborRows::blockOf(sortedIndex) * kSlotsPerBlock;
    while (rows.ownIndices.at(laneSlot) != static_cast<std::int32_t>(sortedIndex)) ++laneSlot;
    return laneSlot;
}

std::size_t roomOf(const NeighborRows& rows) {
    std::size_t sum = 0;
    for (const RowBlock& block : rows.blocks) sum += block.entries.capacity();
    return sum;
}

std::size_t bytesOf(const NeighborRows& rows) {
    std::size_t sum = bytesHeld(rows.ownIndices, rows.length, rows.blocks);
    for (const RowBlock& block : rows.blocks) sum += bytesHeld(block.entries);
    return sum;
}

std::size_t bytesOf(const NeighborList& list) {
    const Candidates& candidates = list.scratch.candidates;
    std::size_t bytes = bytesOf(list.rows) + bytesHeld(list.order, list.sortedIndexOf, list.builtAt, candidates.x,
                                                       candidates.y, candidates.z);
    for (const SizeClass& sizeClass : list.scratch.classes)
        bytes += bytesHeld(sizeClass.members, sizeClass.grid.start, sizeClass.grid.order, sizeClass.grid.cellOf);
    return bytes;
}

}  // namespace engine
