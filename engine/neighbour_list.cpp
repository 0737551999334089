// Rows are found chunk by chunk, then put together in order, whoever found them. The lanes of a group wait for its
// longest row: particles with rows of like length are given places side by side.
#include "engine/neighbour_list.h"

#include <algorithm>
#include <array>

#include "engine/extent.h"
#include "engine/parallel.h"

namespace engine {
namespace {

/// Groups whose rows are found together. Chosen: some tens of microseconds in a dense scene.
constexpr std::size_t kGroupsPerChunk = 8;

/// Places of a chunk.
CellRange chunkOf(const NeighbourList& list, std::size_t number) {
    const std::size_t size = kGroupsPerChunk * kGroup;
    return {static_cast<std::uint32_t>(number * size),
            static_cast<std::uint32_t>(std::min((number + 1) * size, list.count()))};
}

/// Places among which particles are put in order of the lengths of their rows. Chosen: a few groups, whose neighbours
/// are mostly the same.
constexpr std::size_t kWindow = 64;

/// Where each of a window's rows goes, longest first: a counting sort, in which all that are far shorter are one.
std::array<std::uint32_t, kWindow> ranksOf(const std::uint32_t* lengths, std::uint32_t count) {
    constexpr std::uint32_t kLengths = 128;
    const std::uint32_t longest = *std::max_element(lengths, lengths + count);
    const auto shortness = [&](std::uint32_t at) { return std::min(longest - lengths[at], kLengths - 1); };
    std::array<std::uint32_t, kLengths + 1> next = {};
    for (std::uint32_t at = 0; at < count; ++at) ++next[shortness(at) + 1];
    for (std::uint32_t length = 0; length < kLengths; ++length) next[length + 1] += next[length];
    std::array<std::uint32_t, kWindow> ranks = {};
    for (std::uint32_t at = 0; at < count; ++at) ranks[at] = next[shortness(at)]++;
    return ranks;
}

/// Moves the particles of a window to the places that their rows' lengths give them.
void sortWindow(NeighbourList& list, std::uint32_t begin, std::uint32_t end) {
    std::array<std::uint32_t, kWindow> lengths, particles;
    std::copy(list.rows.length.begin() + begin, list.rows.length.begin() + end, lengths.begin());
    std::copy(list.order.begin() + begin, list.order.begin() + end, particles.begin());
    const auto ranks = ranksOf(lengths.data(), end - begin);
    for (std::uint32_t at = 0; at < end - begin; ++at) {
        const std::uint32_t place = begin + ranks[at];
        list.scratch.placeFor[begin + at] = place;
        list.rows.length[place] = lengths[at];
        list.order[place] = particles[at];
        list.placeOf[particles[at]] = place;
    }
}

/// Finds the chunk's rows; the start of a group becomes the length of the longest one before it.
void search(NeighbourList& list, const CellRange& chunk, FoundRows& found) {
    Surroundings scratch;
    for (std::uint32_t place = chunk.begin; place < chunk.end;) {
        const std::uint32_t cell = list.scratch.grid.cellOf[list.order[place]];
        const CellRange selves{place, std::min(list.scratch.grid.start[cell + 1], chunk.end)};
        findInReach(list.scratch.candidates, neighbourhood(list.scratch.grid, cell), selves, list.reach, scratch, found,
                    &list.rows.length[place]);
        place = selves.end;
    }
    for (std::uint32_t begin = chunk.begin; begin < chunk.end; begin += kWindow)
        sortWindow(list, begin, std::min<std::uint32_t>(begin + kWindow, chunk.end));
    for (std::size_t group = chunk.begin / kGroup; group * kGroup < chunk.end; ++group) {
        const auto first = list.rows.length.begin() + static_cast<std::ptrdiff_t>(group * kGroup);
        list.rows.start[group + 1] = *std::max_element(first, first + kGroup);
    }
}

/// Interleaves the chunk's rows, which were found in the order of the cells.
void layOut(NeighbourList& list, const CellRange& chunk, const FoundRows& found) {
    LaneRows& rows = list.rows;
    const std::vector<std::uint32_t>& placeFor = list.scratch.placeFor;
    std::array<const std::uint32_t*, kGroupsPerChunk * kGroup> rowOf;
    const std::uint32_t* next = found.places.data();
    for (std::uint32_t at = chunk.begin; at < chunk.end; ++at) {
        const std::uint32_t place = placeFor[at];
        rowOf[place - chunk.begin] = next;
        next += rows.length[place] + 1;
    }
    // Where nobody is, somebody's own place.
    std::fill(rowOf.begin() + (chunk.end - chunk.begin), rowOf.end(), next - 1);
    for (std::uint32_t first = chunk.begin; first < chunk.end; first += kGroup) {
        const auto* const row = &rowOf[first - chunk.begin];
        const std::uint32_t* const length = &rows.length[first];
        const std::uint32_t longest = rows.start[first / kGroup + 1] - rows.start[first / kGroup];
        std::int32_t* to = &rows.places[rows.at(first, 0)];
        for (std::uint32_t k = 0; k < longest; ++k)
            for (std::uint32_t lane = 0; lane < kGroup; ++lane)
                *to++ = static_cast<std::int32_t>(placeFor[row[lane][std::min(k, length[lane])]]);
    }
}

void sortByCell(NeighbourList& list, const std::vector<Vec3>& positions) {
    list.order.swap(list.scratch.grid.order);
    const std::size_t count = list.order.size();
    list.placeOf.resize(count);
    list.scratch.placeFor.resize(count);
    list.scratch.candidates.x.resize(count + kSearchOverhang);
    list.scratch.candidates.y.resize(count + kSearchOverhang);
    list.scratch.candidates.z.resize(count + kSearchOverhang);
    inParallel(count, kParticleGrain, [&](std::size_t place) {
        const Vec3& position = positions[list.order[place]];
        list.scratch.candidates.x[place] = position.x();
        list.scratch.candidates.y[place] = position.y();
        list.scratch.candidates.z[place] = position.z();
    });
}

}  // namespace

void build(NeighbourList& list, const std::vector<Vec3>& positions, double cutoff, double skin) {
    list.reach = cutoff + skin;
    copy(positions, list.builtAt);
    build(list.scratch.grid, positions, list.reach);
    sortByCell(list, positions);
    const std::size_t groups = (list.count() + kGroup - 1) / kGroup;
    const std::size_t chunks = (groups + kGroupsPerChunk - 1) / kGroupsPerChunk;
    list.rows.length.assign(groups * kGroup, 0);
    list.rows.start.assign(groups + 1, 0);
    list.scratch.found.resize(chunks);
    inParallel(chunks, 1, [&](std::size_t c) {
        list.scratch.found[c].used = 0;
        search(list, chunkOf(list, c), list.scratch.found[c]);
    });
    for (std::size_t group = 0; group < groups; ++group) list.rows.start[group + 1] += list.rows.start[group];
    list.entryCount = 0;
    for (const std::uint32_t length : list.rows.length) list.entryCount += length;
    // One more than there are: kernels read past the end of a row before they see that it is the last, or empty.
    list.rows.places.resize((list.rows.start[groups] + 1) * kGroup);
    std::fill(list.rows.places.end() - kGroup, list.rows.places.end(), 0);
    inParallel(chunks, 1, [&](std::size_t c) { layOut(list, chunkOf(list, c), list.scratch.found[c]); });
}

bool covers(const NeighbourList& list, const std::vector<Vec3>& positions, double cutoff) {
    // A list that is forgotten has its order still.
    if (positions.size() != list.builtAt.size() || positions.size() != list.count() || cutoff > list.reach)
        return false;
    if (positions.empty()) return true;
    const double slack = 0.5 * (list.reach - cutoff);
    const auto way = [&](std::size_t p) -> Vec3 { return positions[p] - list.builtAt[p]; };
    if (farthestFrom(Vec3::Zero(), positions.size(), way) <= slack) return true;  // mostly, and soon known
    return farthestFrom(extentOver(positions.size(), way).middle(), positions.size(), way) <= slack;
}

std::size_t bytesOf(const NeighbourList& list) {
    const auto held = [](const auto&... vectors) {
        return (std::size_t{0} + ... + (vectors.capacity() * sizeof(vectors[0])));
    };
    std::size_t bytes =
        held(list.order, list.placeOf, list.rows.start, list.rows.length, list.rows.places, list.builtAt,
             list.scratch.grid.start, list.scratch.grid.order, list.scratch.grid.cellOf, list.scratch.candidates.x,
             list.scratch.candidates.y, list.scratch.candidates.z, list.scratch.placeFor, list.scratch.found);
    for (const FoundRows& found : list.scratch.found) bytes += held(found.places);
    return bytes;
}

}  // namespace engine
