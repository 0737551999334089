// SIMD search for neighbors, compiled once per instruction set. Most candidates are out of reach, and which ones is
// unpredictable. So a SIMD vector of candidates is compared at a time, and the candidates within reach are packed
// without a branch.
#include "engine/neighbors/list_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/neighbors/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/neighbors/simd_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

constexpr hn::CappedTag<double, kSearchOverhang> kDoubles{};
constexpr hn::Rebind<float, decltype(kDoubles)> kFloats{};             // as many lanes
constexpr hn::Rebind<std::uint32_t, decltype(kDoubles)> kPositions{};  // as many lanes
constexpr Tag<float> kTag{};
static_assert(hn::MaxLanes(kTag) <= 2 * kSearchOverhang &&
              hn::MaxLanes(kTag) <= 16);  // the bits of SearchScratch::near
constexpr hn::RebindToUnsigned<decltype(kTag)> kIndices{};
constexpr hn::CappedTag<std::uint16_t, 64> kMasks{};

std::uint32_t countOf(std::span<const CellRange> around) {
    std::uint32_t sum = 0;
    for (const CellRange& range : around) sum += range.end - range.begin;
    return sum;
}

#if HWY_TARGET > HWY_AVX3
/// For each subset of eight lanes, given by the bits of an index, the numbers of its lanes in ascending order. The
/// numbers after them have no meaning.
constexpr auto kPackings = [] {
    std::array<std::array<std::uint8_t, 8>, 256> all{};
    for (std::size_t chosen = 0; chosen < all.size(); ++chosen) {
        std::size_t found = 0;
        for (std::uint8_t k = 0; k < 8; ++k)
            if (((chosen >> k) & 1U) != 0) all[chosen][found++] = k;
    }
    return all;
}();
#endif

/// Stores the lanes that are chosen by bits side by side and returns their number; `to` is overwritten beyond them.
/// Replaces Highway's CompressStore: with it building lists takes four times as long on processors with slow
/// compressing stores (Zen 4), and GCC copies its table to the stack at every look-up.
std::size_t pack(hn::Vec<decltype(kIndices)> indices, std::uint16_t chosen, std::uint32_t* to) {
#if HWY_TARGET <= HWY_AVX3
    const std::array<std::uint8_t, 8> bytes = {static_cast<std::uint8_t>(chosen),
                                               static_cast<std::uint8_t>(chosen >> 8U)};
    hn::StoreU(hn::Compress(indices, hn::LoadMaskBits(kIndices, bytes.data())), kIndices, to);
#else
    static_assert(hn::MaxLanes(kIndices) <= 8);
    constexpr hn::Rebind<std::uint8_t, decltype(kIndices)> kBytes{};
    const auto lanes = hn::PromoteTo(kIndices, hn::LoadU(kBytes, kPackings[chosen].data()));
    hn::StoreU(hn::TableLookupLanes(indices, hn::IndicesFromVec(kIndices, lanes)), kIndices, to);
#endif
    return static_cast<std::size_t>(std::popcount(chosen));
}

/// The search for the neighbors of a group of particles that are close together.
struct Search {
    const Candidates& candidates;
    std::span<const CellRange> around;
    double perReach;        ///< 1/m
    std::uint32_t count;    ///< number of candidates
    std::uint32_t skipped;  ///< number of the first candidates, which are no neighbors of any particle
    SearchScratch& scratch;
    Vec3 origin;  ///< position of the group's first particle, m

    Vec3 positionOf(std::uint32_t sortedIndex) const {
        return {candidates.x[sortedIndex], candidates.y[sortedIndex], candidates.z[sortedIndex]};
    }

    /// Whether a particle is close enough to the origin for float to resolve the distances of its neighbors.
    bool isInFloatRange(std::uint32_t sortedIndex) const {
        return ((positionOf(sortedIndex) - origin).array().abs() < kFloatRange / perReach).all();
    }

    /// Copies the positions of the candidates to float, relative to a new origin (m).
    void loadCandidates(const Vec3& newOrigin) {
        origin = newOrigin;
        const auto atOnce = static_cast<std::uint32_t>(hn::Lanes(kDoubles));
        const auto counting = hn::Iota(kPositions, 0);  // outside of the loop, because it is loaded from memory
        std::uint32_t used = 0;
        for (const CellRange& range : around) {
            for (std::uint32_t other = range.begin; other < range.end; other += atOnce) {
                const std::uint32_t at = used + other - range.begin;
                storeRelative(candidates.x, other, origin.x(), &scratch.x[at]);
                storeRelative(candidates.y, other, origin.y(), &scratch.y[at]);
                storeRelative(candidates.z, other, origin.z(), &scratch.z[at]);
                hn::StoreU(hn::Add(hn::Set(kPositions, other), counting), kPositions, &scratch.sortedIndices[at]);
            }
            used += range.end - range.begin;
        }
        // Adds a vector of candidates that are infinitely far away, since whole vectors are read below.
        hn::StoreU(hn::Set(kTag, std::numeric_limits<float>::infinity()), kTag, &scratch.x[used]);
    }

    void storeRelative(const std::vector<double>& coordinate, std::uint32_t other, double from, float* to) const {
        const auto away = hn::Sub(hn::LoadU(kDoubles, &coordinate[other]), hn::Set(kDoubles, from));
        hn::StoreU(hn::DemoteTo(kFloats, hn::Mul(away, hn::Set(kDoubles, perReach))), kFloats, to);
    }

    /// Index among the candidates of the particle with a sorted index.
    std::uint32_t candidateAt(std::uint32_t sortedIndex) const {
        std::uint32_t before = 0;
        for (const CellRange& range : around) {
            if (range.begin <= sortedIndex && sortedIndex < range.end) return before + sortedIndex - range.begin;
            before += range.end - range.begin;
        }
        throw std::logic_error("a particle is not among its own candidates");
    }

    /// Number of SIMD vectors that the candidates fill.
    std::uint32_t vectors() const { return (count + lanes() - 1) / lanes(); }

    static std::uint32_t lanes() { return static_cast<std::uint32_t>(hn::Lanes(kTag)); }

    /// Records which candidates are near to each of the `ownCount` particles that are the candidates from `first` on.
    /// Each vector of candidates is compared with all of these particles while it is in registers.
    void findNear(std::uint32_t first, std::uint32_t ownCount) {
        const std::size_t stride = vectors();
        const std::size_t room = ownCount * stride + hn::Lanes(kMasks);  // writeRow() reads beyond the last mask
        if (scratch.near.size() < room) scratch.near.resize(2 * room);
        const float* const xs = scratch.x.data();
        const float* const ys = scratch.y.data();
        const float* const zs = scratch.z.data();
        const auto limit = hn::Set(kTag, kFloatMargin);
        for (std::uint32_t k = 0; k < stride; ++k) {
            std::uint16_t* near = &scratch.near[k];
            const auto x = hn::LoadU(kTag, xs + k * lanes());
            const auto y = hn::LoadU(kTag, ys + k * lanes());
            const auto z = hn::LoadU(kTag, zs + k * lanes());
            for (std::uint32_t candidate = first; candidate < first + ownCount; ++candidate, near += stride) {
                const auto dx = hn::Sub(hn::Set(kTag, xs[candidate]), x);
                const auto dy = hn::Sub(hn::Set(kTag, ys[candidate]), y);
                const auto dz = hn::Sub(hn::Set(kTag, zs[candidate]), z);
                const auto distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                *near = static_cast<std::uint16_t>(bitsOf<float>(hn::Lt(distanceSq, limit)));
            }
        }
        // A particle is not a neighbor of itself.
        const auto exclude = [&](std::uint32_t nth, std::uint32_t candidate) {
            scratch.near[nth * stride + candidate / lanes()] &=
                static_cast<std::uint16_t>(~(1U << candidate % lanes()));
        };
        for (std::uint32_t nth = 0; nth < ownCount; ++nth) {
            if (skipped == 0) exclude(nth, first + nth);
            for (std::uint32_t candidate = 0; candidate < skipped; ++candidate) exclude(nth, candidate);
        }
    }

    /// Writes the row of neighbors of the group's nth particle and returns the length of the row.
    std::size_t writeRow(std::uint32_t nth, std::uint32_t* row) const {
        const auto atOnce = static_cast<std::uint32_t>(hn::Lanes(kMasks));
        const std::uint16_t* const near = &scratch.near[std::size_t{nth} * vectors()];
        const std::uint32_t* const all = scratch.sortedIndices.data();
        std::size_t length = 0;
        const auto take = [&](std::uint32_t k) {
            length += pack(hn::LoadU(kIndices, all + k * lanes()), near[k], row + length);
        };
        // Measured with `globular bench --filter list`: few vectors are packed faster than it is tested which of them
        // are empty; of many, half are empty, and packing them takes a fifth of a dense list's time.
        constexpr std::uint32_t kFewVectors = 12;
        if (vectors() <= kFewVectors) {
            for (std::uint32_t k = 0; k < vectors(); ++k) take(k);
            return length;
        }
        for (std::uint32_t k = 0; k < vectors(); k += atOnce) {
            std::uint64_t some = 0;  // one bit for each vector, in little-endian bytes
            hn::StoreMaskBits(kMasks, hn::Ne(hn::LoadU(kMasks, near + k), hn::Zero(kMasks)),
                              reinterpret_cast<std::uint8_t*>(&some));
            const std::uint32_t left = vectors() - k;
            if (left < atOnce) some &= (std::uint64_t{1} << left) - 1;
            for (; some != 0; some &= some - 1) take(k + static_cast<std::uint32_t>(std::countr_zero(some)));
        }
        return length;
    }
};

void findInReachHere(const Candidates& candidates, std::span<const CellRange> around, CellRange own,
                     std::uint32_t skipped, double reach, SearchScratch& scratch, FoundRows& rows,
                     std::uint32_t* lengths) {
    const std::uint32_t count = countOf(around);
    const std::size_t room = count + 4 * kSearchOverhang;
    if (scratch.sortedIndices.size() < room) {
        for (std::vector<float>* of : {&scratch.x, &scratch.y, &scratch.z}) of->resize(2 * room);
        scratch.sortedIndices.resize(2 * room);
    }
    Search search{candidates, around, 1.0 / reach, count, skipped, scratch, {}};
    for (std::uint32_t begin = own.begin; begin < own.end;) {
        // Particles that share a cell in storage may be far apart. A particle too far from the origin becomes a new
        // origin.
        search.loadCandidates(search.positionOf(begin));
        std::uint32_t end = begin + 1;
        while (end < own.end && search.isInFloatRange(end)) ++end;
        search.findNear(search.candidateAt(begin), end - begin);
        for (std::uint32_t self = begin; self < end; ++self) {
            if (rows.sortedIndices.size() < rows.used + room)
                rows.sortedIndices.resize(rows.used + rows.used / 2 + room);
            const std::size_t length = search.writeRow(self - begin, &rows.sortedIndices[rows.used]);
            lengths[self - own.begin] = static_cast<std::uint32_t>(length);
            rows.used += length;
        }
        begin = end;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(findInReachHere);

void findInReach(const Candidates& candidates, std::span<const CellRange> around, CellRange own, std::uint32_t skipped,
                 double reach, SearchScratch& scratch, FoundRows& rows, std::uint32_t* lengths) {
    HWY_DYNAMIC_DISPATCH(findInReachHere)(candidates, around, own, skipped, reach, scratch, rows, lengths);
}

}  // namespace engine

#endif
