// Compiled once per instruction set. Most candidates are out of reach, unpredictably so: vectors of them are packed
// without a branch.
#include "engine/neighbors/list_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

#include "engine/neighbors/pack_table.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/neighbors/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/neighbors/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

constexpr hn::CappedTag<double, kSearchOverhang> kWide{};
constexpr hn::Rebind<float, decltype(kWide)> kNarrow{};       // as many
constexpr hn::Rebind<std::uint32_t, decltype(kWide)> kFew{};  // as many
constexpr Tag<float> kTag{};
static_assert(hn::MaxLanes(kTag) <= 2 * kSearchOverhang && hn::MaxLanes(kTag) <= 16);  // bits of a number of 16
constexpr hn::RebindToUnsigned<decltype(kTag)> kPlaces{};
constexpr hn::CappedTag<std::uint16_t, 64> kNear{};

std::uint32_t countOf(const Neighborhood& around) {
    std::uint32_t sum = 0;
    for (int r = 0; r < around.count; ++r)
        sum += around.ranges[static_cast<std::size_t>(r)].end - around.ranges[static_cast<std::size_t>(r)].begin;
    return sum;
}

/// As CompressStore, whose table gcc copies to the stack whenever it looks something up, and with which lists take four
/// times as long on processors (Zen 4) that are slow to store what they pack. Shape: a bit a lane.
std::size_t pack(hn::Vec<decltype(kPlaces)> sortedIndices, std::uint16_t chosen, std::uint32_t* to) {
#if HWY_TARGET <= HWY_AVX3
    const std::array<std::uint8_t, 8> bytes = {static_cast<std::uint8_t>(chosen),
                                               static_cast<std::uint8_t>(chosen >> 8U)};
    hn::StoreU(hn::Compress(sortedIndices, hn::LoadMaskBits(kPlaces, bytes.data())), kPlaces, to);
#else
    static_assert(hn::MaxLanes(kPlaces) <= kPacked);
    constexpr hn::Rebind<std::uint8_t, decltype(kPlaces)> kBytes{};
    const auto numbers = hn::PromoteTo(kPlaces, hn::LoadU(kBytes, kPackings[chosen].data()));
    hn::StoreU(hn::TableLookupLanes(sortedIndices, hn::IndicesFromVec(kPlaces, numbers)), kPlaces, to);
#endif
    return static_cast<std::size_t>(std::popcount(chosen));
}

/// What the particles of a run have in common.
struct Search {
    const Candidates& candidates;
    const Neighborhood& around;
    double perReach;      ///< 1/m
    std::uint32_t count;  ///< of the candidates
    Surroundings& seen;
    Vec3 origin;

    Vec3 positionOf(std::uint32_t sortedIndex) const {
        return {candidates.x[sortedIndex], candidates.y[sortedIndex], candidates.z[sortedIndex]};
    }

    /// Whether float, from the origin, tells apart what is near to a particle.
    bool seesWell(std::uint32_t sortedIndex) const {
        return ((positionOf(sortedIndex) - origin).array().abs() < kClearSight / perReach).all();
    }

    void look(const Vec3& from) {
        origin = from;
        const auto atOnce = static_cast<std::uint32_t>(hn::Lanes(kWide));
        const auto counting = hn::Iota(kFew, 0);  // goes through memory, and would wait for itself in the loop
        std::uint32_t used = 0;
        for (int r = 0; r < around.count; ++r) {
            const CellRange range = around.ranges[static_cast<std::size_t>(r)];
            for (std::uint32_t other = range.begin; other < range.end; other += atOnce) {
                const std::uint32_t at = used + other - range.begin;
                see(candidates.x, other, origin.x(), &seen.x[at]);
                see(candidates.y, other, origin.y(), &seen.y[at]);
                see(candidates.z, other, origin.z(), &seen.z[at]);
                hn::StoreU(hn::Add(hn::Set(kFew, other), counting), kFew, &seen.sortedIndices[at]);
            }
            used += range.end - range.begin;
        }
        // A vector of such as nobody is near to.
        hn::StoreU(hn::Set(kTag, std::numeric_limits<float>::infinity()), kTag, &seen.x[used]);
    }

    void see(const std::vector<double>& coordinate, std::uint32_t other, double from, float* to) const {
        const auto away = hn::Sub(hn::LoadU(kWide, &coordinate[other]), hn::Set(kWide, from));
        hn::StoreU(hn::DemoteTo(kNarrow, hn::Mul(away, hn::Set(kWide, perReach))), kNarrow, to);
    }

    /// Where a sortedIndex stands among the candidates.
    std::uint32_t candidateAt(std::uint32_t sortedIndex) const {
        std::uint32_t before = 0;
        for (int r = 0; r < around.count; ++r) {
            const CellRange range = around.ranges[static_cast<std::size_t>(r)];
            if (range.begin <= sortedIndex && sortedIndex < range.end) return before + sortedIndex - range.begin;
            before += range.end - range.begin;
        }
        throw std::logic_error("who searches is not among those around");
    }

    /// Vectors of candidates.
    std::uint32_t vectors() const { return (count + lanes() - 1) / lanes(); }

    static std::uint32_t lanes() { return static_cast<std::uint32_t>(hn::Lanes(kTag)); }

    /// Notes who is near, for each of some candidates side by side. A vector is compared with all of them while it is
    /// at hand.
    void sift(std::uint32_t first, std::uint32_t ownIndices) {
        const std::size_t stride = vectors();
        const std::size_t room = ownIndices * stride + hn::Lanes(kNear);  // some are read beyond the last
        if (seen.near.size() < room) seen.near.resize(2 * room);
        const float* const xs = seen.x.data();
        const float* const ys = seen.y.data();
        const float* const zs = seen.z.data();
        const auto limit = hn::Set(kTag, kFloatMargin);
        for (std::uint32_t k = 0; k < stride; ++k) {
            std::uint16_t* near = &seen.near[k];
            const auto x = hn::LoadU(kTag, xs + k * lanes());
            const auto y = hn::LoadU(kTag, ys + k * lanes());
            const auto z = hn::LoadU(kTag, zs + k * lanes());
            for (std::uint32_t candidate = first; candidate < first + ownIndices; ++candidate, near += stride) {
                const auto dx = hn::Sub(hn::Set(kTag, xs[candidate]), x);
                const auto dy = hn::Sub(hn::Set(kTag, ys[candidate]), y);
                const auto dz = hn::Sub(hn::Set(kTag, zs[candidate]), z);
                const auto distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
                *near = static_cast<std::uint16_t>(bitsOf<float>(hn::Lt(distanceSq, limit)));
            }
        }
        // Nobody is near to himself.
        for (std::uint32_t nth = 0; nth < ownIndices; ++nth)
            seen.near[nth * stride + (first + nth) / lanes()] &=
                static_cast<std::uint16_t>(~(1U << (first + nth) % lanes()));
    }

    /// Writes the row of one of those and returns its length.
    std::size_t pick(std::uint32_t nth, std::uint32_t* row) const {
        const auto atOnce = static_cast<std::uint32_t>(hn::Lanes(kNear));
        const std::uint16_t* const near = &seen.near[std::size_t{nth} * vectors()];
        const std::uint32_t* const all = seen.sortedIndices.data();
        std::size_t length = 0;
        const auto take = [&](std::uint32_t k) {
            length += pack(hn::LoadU(kPlaces, all + k * lanes()), near[k], row + length);
        };
        // Measured with `globular bench --filter list`: of few vectors all are taken sooner than chosen from; in half
        // of many nobody is near, which takes a fifth of a dense list's time where they are packed all the same.
        constexpr std::uint32_t kFewVectors = 12;
        if (vectors() <= kFewVectors) {
            for (std::uint32_t k = 0; k < vectors(); ++k) take(k);
            return length;
        }
        for (std::uint32_t k = 0; k < vectors(); k += atOnce) {
            std::uint64_t some = 0;  // a bit each, of little-endian bytes
            hn::StoreMaskBits(kNear, hn::Ne(hn::LoadU(kNear, near + k), hn::Zero(kNear)),
                              reinterpret_cast<std::uint8_t*>(&some));
            const std::uint32_t left = vectors() - k;
            if (left < atOnce) some &= (std::uint64_t{1} << left) - 1;
            for (; some != 0; some &= some - 1) take(k + static_cast<std::uint32_t>(std::countr_zero(some)));
        }
        return length;
    }
};

void findInReachHere(const Candidates& candidates, const Neighborhood& around, CellRange ownIndices, double reach,
                     Surroundings& scratch, FoundRows& rows, std::uint32_t* lengths) {
    const std::uint32_t count = countOf(around);
    const std::size_t room = count + 4 * kSearchOverhang;
    if (scratch.sortedIndices.size() < room) {
        for (std::vector<float>* of : {&scratch.x, &scratch.y, &scratch.z}) of->resize(2 * room);
        scratch.sortedIndices.resize(2 * room);
    }
    Search search{candidates, around, 1.0 / reach, count, scratch, {}};
    for (std::uint32_t begin = ownIndices.begin; begin < ownIndices.end;) {
        // Particles that are far apart may share a cell.
        search.look(search.positionOf(begin));
        std::uint32_t end = begin + 1;
        while (end < ownIndices.end && search.seesWell(end)) ++end;
        search.sift(search.candidateAt(begin), end - begin);
        for (std::uint32_t self = begin; self < end; ++self) {
            if (rows.sortedIndices.size() < rows.used + room)
                rows.sortedIndices.resize(rows.used + rows.used / 2 + room);
            const std::size_t length = search.pick(self - begin, &rows.sortedIndices[rows.used]);
            lengths[self - ownIndices.begin] = static_cast<std::uint32_t>(length);
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

void findInReach(const Candidates& candidates, const Neighborhood& around, CellRange ownIndices, double reach,
                 Surroundings& scratch, FoundRows& rows, std::uint32_t* lengths) {
    HWY_DYNAMIC_DISPATCH(findInReachHere)(candidates, around, ownIndices, reach, scratch, rows, lengths);
}

}  // namespace engine

#endif
