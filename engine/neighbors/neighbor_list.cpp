// Rows are found part by part, and laid out while they are in the cache of whoever found them. The lanes of a group
// wait for its longest row: particles with rows of like length are seated side by side.
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

/// The places and the seats of a part.
CellRange rangeOf(const NeighborList& list, std::size_t part) {
    return {static_cast<std::uint32_t>(part * kSeatsPerPart),
            static_cast<std::uint32_t>(std::min((part + 1) * kSeatsPerPart, list.count()))};
}

/// Which seat of a part each of its rows gets, the longest first: a counting sort, in which all that are far shorter
/// are one.
std::array<std::uint32_t, kSeatsPerPart> ranksOf(const std::uint32_t* lengths, std::uint32_t count) {
    constexpr std::uint32_t kLengths = 128;
    const std::uint32_t longest = *std::max_element(lengths, lengths + count);
    const std::uint32_t last = std::min(longest - *std::min_element(lengths, lengths + count), kLengths - 1);
    const auto shortness = [&](std::uint32_t at) { return std::min(longest - lengths[at], last); };
    std::array<std::uint32_t, kLengths + 1> next = {};
    for (std::uint32_t at = 0; at < count; ++at) ++next[shortness(at) + 1];
    for (std::uint32_t length = 0; length < last; ++length) next[length + 1] += next[length];
    std::array<std::uint32_t, kSeatsPerPart> ranks = {};
    for (std::uint32_t at = 0; at < count; ++at) ranks[at] = next[shortness(at)]++;
    return ranks;
}

/// Rows of a part as they are found, in the order of places. Kept by each thread.
struct FoundPart {
    Surroundings surroundings;
    FoundRows rows;
    std::array<std::uint32_t, kSeatsPerPart> lengths;
    CellRange around;  ///< from the first place to the last that may occur
};

/// What is around some cells is looked at once for so many particles, if they are no further apart than float sees
/// well. Measured with `globular bench --filter list`: a quarter less time for powder than cell by cell; 6 to 32 are
/// alike.
constexpr std::uint32_t kRunParticles = 12;
constexpr auto kRunCells = static_cast<std::uint32_t>(kClearSight);

void search(const NeighborList& list, const CellRange& range, FoundPart& found) {
    found.rows.used = 0;
    found.around = range;
    const CellGrid& grid = list.scratch.grid;
    std::uint32_t cell = cellOfPlace(grid, range.begin);
    for (std::uint32_t place = range.begin; place < range.end;) {
        while (grid.start[cell + 1] <= place) ++cell;
        const CellRun run = runFrom(grid, cell, kRunParticles, kRunCells);
        const CellRange selves{place, std::min(grid.start[run.last + 1], range.end)};
        const Neighborhood around = neighborhood(grid, run);
        for (int r = 0; r < around.count; ++r) {
            found.around.begin = std::min(found.around.begin, around.ranges[static_cast<std::size_t>(r)].begin);
            found.around.end = std::max(found.around.end, around.ranges[static_cast<std::size_t>(r)].end);
        }
        findInReach(list.scratch.candidates, around, selves, list.reach, found.surroundings, found.rows,
                    &found.lengths[place - range.begin]);
        place = selves.end;
    }
}

/// Rows of a part by seat.
using Seated = std::array<const std::uint32_t*, kSeatsPerPart>;

/// Seats the particles of a part.
Seated seatParticles(NeighborList& list, const CellRange& range, const FoundPart& found) {
    Seated rows;
    const std::uint32_t* next = found.rows.places.data();
    const std::uint32_t count = range.end - range.begin;
    const auto ranks = ranksOf(found.lengths.data(), count);
    for (std::uint32_t of = 0; of < count; ++of) {
        const std::uint32_t place = range.begin + of;
        const std::uint32_t seat = range.begin + ranks[of];
        rows[ranks[of]] = next;
        next += found.lengths[of] + kRowPadding;
        list.rows.length[seat] = found.lengths[of];
        list.rows.selves[seat] = static_cast<std::int32_t>(place);
    }
    // Where nobody is, the last one's padding.
    std::fill(rows.begin() + count, rows.end(), next - kRowPadding);
    return rows;
}

/// Room for so many entries, and not much more: rows of a part change little from list to list.
template <class Entry>
void makeRoom(std::vector<Entry>& places, std::size_t entries) {
    if (places.capacity() < entries) {
        places = std::vector<Entry>();
        places.reserve(entries + entries / 8);
    }
    places.resize(entries);
}

/// Lays out the rows of the groups of a part. Shape: length: of each seat's row.
template <class Entry>
void layOut(const Seated& seated, const std::uint32_t* length, std::size_t groups, RowPart& part) {
    std::vector<Entry>& entries = entriesOf<Entry>(part);
    makeRoom(entries, (part.start[groups] + 1) * kGroup);
    std::fill(entries.end() - kGroup, entries.end(), Entry(0));
    for (std::size_t group = 0; group < groups; ++group) {
        GroupRows rows;
        std::copy_n(&seated[group * kGroup], kGroup, rows.row.begin());
        std::copy_n(length + group * kGroup, kGroup, rows.length.begin());
        rows.longest = part.start[group + 1] - part.start[group];
        interleave(rows, part.base, &entries[part.start[group] * kGroup]);
    }
}

/// Finds the rows of a part and lays them out.
void fill(NeighborList& list, std::size_t number) {
    thread_local FoundPart found;
    const CellRange range = rangeOf(list, number);
    search(list, range, found);
    const CellGrid& grid = list.scratch.grid;
    list.fronts[number] = frontOf(grid, cellOfPlace(grid, range.begin), cellOfPlace(grid, range.end - 1));
    const Seated seated = seatParticles(list, range, found);
    RowPart& part = list.rows.parts[number];
    const std::uint32_t* const length = &list.rows.length[range.begin];
    const std::size_t groups = (range.end - range.begin + kGroup - 1) / kGroup;
    part.start[0] = 0;
    for (std::size_t group = 0; group < kGroupsPerPart; ++group) {
        const std::uint32_t* const first = length + group * kGroup;
        part.start[group + 1] = part.start[group] + (group < groups ? *std::max_element(first, first + kGroup) : 0);
    }
    part.base = found.around.begin;
    constexpr std::uint32_t kNarrow = std::numeric_limits<std::uint16_t>::max();
    if (found.around.end - 1 - part.base <= kNarrow) {
        part.wide = std::vector<std::int32_t>();
        layOut<std::uint16_t>(seated, length, groups, part);
    } else {
        part.narrow = std::vector<std::uint16_t>();
        layOut<std::int32_t>(seated, length, groups, part);
    }
}

void sortByCell(NeighborList& list, const std::vector<Vec3>& positions) {
    list.order.swap(list.scratch.grid.order);
    const std::size_t count = list.order.size();
    list.placeOf.resize(count);
    Candidates& candidates = list.scratch.candidates;
    for (std::vector<double>* of : {&candidates.x, &candidates.y, &candidates.z}) of->resize(count + kSearchOverhang);
    inParallel(count, kParticleGrain, [&](std::size_t place) {
        const std::uint32_t p = list.order[place];
        list.placeOf[p] = static_cast<std::uint32_t>(place);
        candidates.x[place] = positions[p].x();
        candidates.y[place] = positions[p].y();
        candidates.z[place] = positions[p].z();
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
    const std::size_t groups = (list.count() + kGroup - 1) / kGroup;
    const std::size_t parts = (groups + kGroupsPerPart - 1) / kGroupsPerPart;
    list.rows.selves.assign(groups * kGroup, static_cast<std::int32_t>(list.count()) - 1);
    list.rows.length.assign(groups * kGroup, 0);
    list.rows.parts.resize(parts);
    list.fronts.resize(parts);
    inParallel(parts, 1, [&](std::size_t part) { fill(list, part); });
    list.entryCount = std::accumulate(list.rows.length.begin(), list.rows.length.end(), std::size_t{0});
}

std::size_t NeighborList::seatOf(std::size_t p) const {
    // Few ask: written down for all, seats would take longer than to be looked for.
    const std::uint32_t place = placeOf[p];
    std::size_t seat = LaneRows::partOf(place) * kSeatsPerPart;
    while (rows.selves.at(seat) != static_cast<std::int32_t>(place)) ++seat;
    return seat;
}

bool coversWithin(const NeighborList& list, const Extent& displacements, std::size_t count, double cutoff) {
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
    const Extent young = extentOver(some, [&](std::size_t p) { return way(positions.size() - some + p); });
    constexpr double kMargin = 1.0 + 1e-6;  // far above what the look at each of them rounds
    if ((young.high - young.low).maxCoeff() > 2.0 * kMargin * slack) return false;
    return areWithin(slack, extentOver(positions.size(), way).middle(), positions.size(), way);
}

std::size_t roomOf(const LaneRows& rows) {
    std::size_t sum = 0;
    for (const RowPart& part : rows.parts) sum += part.isWide() ? part.wide.capacity() : part.narrow.capacity();
    return sum;
}

std::size_t bytesOf(const LaneRows& rows) {
    std::size_t sum = bytesHeld(rows.selves, rows.length, rows.parts);
    for (const RowPart& part : rows.parts) sum += part.bytes();
    return sum;
}

std::size_t bytesOf(const NeighborList& list) {
    const BuildScratch& scratch = list.scratch;
    return bytesOf(list.rows) + bytesHeld(list.order, list.placeOf, list.fronts, list.builtAt, scratch.grid.start,
                                          scratch.grid.order, scratch.grid.cellOf, scratch.candidates.x,
                                          scratch.candidates.y, scratch.candidates.z);
}

}  // namespace engine
