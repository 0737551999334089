// Compiled once per instruction set. Most candidates are out of reach, unpredictably so: vectors of them are packed
// without a branch.
#include "engine/list_search.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "engine/packings.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<double, kSearchOverhang> kWide{};
constexpr hn::Rebind<float, decltype(kWide)> kNarrow{};       // as many
constexpr hn::Rebind<std::uint32_t, decltype(kWide)> kFew{};  // as many
constexpr hn::CappedTag<float, 2 * kSearchOverhang> kTag{};
constexpr hn::RebindToUnsigned<decltype(kTag)> kPlaces{};

std::uint32_t countOf(const Neighbourhood& around) {
    std::uint32_t sum = 0;
    for (int r = 0; r < around.count; ++r)
        sum += around.ranges[static_cast<std::size_t>(r)].end - around.ranges[static_cast<std::size_t>(r)].begin;
    return sum;
}

/// As CompressStore, whose table gcc copies to the stack whenever it looks something up, and with which lists take four
/// times as long on processors (Zen 4) that are slow to store what they pack.
std::size_t pack(hn::Vec<decltype(kPlaces)> places, hn::Mask<decltype(kPlaces)> chosen, std::uint32_t* to) {
#if HWY_TARGET <= HWY_AVX3
    hn::StoreU(hn::Compress(places, chosen), kPlaces, to);
    return hn::CountTrue(kPlaces, chosen);
#else
    static_assert(hn::MaxLanes(kPlaces) <= kPacked);
    constexpr hn::Rebind<std::uint8_t, decltype(kPlaces)> kBytes{};
    std::array<std::uint8_t, 8> bits = {};
    hn::StoreMaskBits(kPlaces, chosen, bits.data());
    const auto numbers = hn::PromoteTo(kPlaces, hn::LoadU(kBytes, kPackings[bits[0]].data()));
    hn::StoreU(hn::TableLookupLanes(places, hn::IndicesFromVec(kPlaces, numbers)), kPlaces, to);
    return static_cast<std::size_t>(std::popcount(bits[0]));
#endif
}

/// What the particles of a cell have in common.
struct Search {
    const Candidates& candidates;
    const Neighbourhood& around;
    double perReach;      ///< 1/m
    std::uint32_t count;  ///< of the candidates
    Surroundings& seen;
    Vec3 origin;

    Vec3 positionOf(std::uint32_t place) const {
        return {candidates.x[place], candidates.y[place], candidates.z[place]};
    }

    void look(const Vec3& from) {
        origin = from;
        const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kWide));
        const auto counting = hn::Iota(kFew, 0);  // goes through memory, and would wait for itself in the loop
        std::uint32_t used = 0;
        for (int r = 0; r < around.count; ++r) {
            const CellRange range = around.ranges[static_cast<std::size_t>(r)];
            for (std::uint32_t other = range.begin; other < range.end; other += lanes) {
                const std::uint32_t at = used + other - range.begin;
                see(candidates.x, other, origin.x(), &seen.x[at]);
                see(candidates.y, other, origin.y(), &seen.y[at]);
                see(candidates.z, other, origin.z(), &seen.z[at]);
                hn::StoreU(hn::Add(hn::Set(kFew, other), counting), kFew, &seen.places[at]);
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

    /// Writes a row and returns its length.
    std::size_t sift(std::uint32_t self, std::uint32_t* row) const {
        const Vec3 from = (positionOf(self) - origin) * perReach;
        const auto x = hn::Set(kTag, static_cast<float>(from.x()));
        const auto y = hn::Set(kTag, static_cast<float>(from.y()));
        const auto z = hn::Set(kTag, static_cast<float>(from.z()));
        const auto limit = hn::Set(kTag, kFloatMargin);
        const auto own = hn::Set(kPlaces, self);
        const float* const xs = seen.x.data();
        const float* const ys = seen.y.data();
        const float* const zs = seen.z.data();
        const std::uint32_t* const all = seen.places.data();
        std::size_t length = 0;
        for (std::uint32_t k = 0; k < count; k += static_cast<std::uint32_t>(hn::Lanes(kTag))) {
            const auto dx = hn::Sub(x, hn::LoadU(kTag, xs + k));
            const auto dy = hn::Sub(y, hn::LoadU(kTag, ys + k));
            const auto dz = hn::Sub(z, hn::LoadU(kTag, zs + k));
            const auto distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
            const auto places = hn::LoadU(kPlaces, all + k);
            const auto isNear = hn::And(hn::RebindMask(kPlaces, hn::Lt(distanceSq, limit)), hn::Ne(places, own));
            length += pack(places, isNear, row + length);
        }
        return length;
    }
};

void findInReachHere(const Candidates& candidates, const Neighbourhood& around, CellRange selves, double reach,
                     Surroundings& scratch, FoundRows& rows, std::uint32_t* lengths) {
    const std::uint32_t count = countOf(around);
    const std::size_t room = count + 2 * kSearchOverhang + kRowPadding;
    if (scratch.places.size() < room) {
        for (std::vector<float>* of : {&scratch.x, &scratch.y, &scratch.z}) of->resize(2 * room);
        scratch.places.resize(2 * room);
    }
    Search search{candidates, around, 1.0 / reach, count, scratch, {}};
    search.look(search.positionOf(selves.begin));
    for (std::uint32_t self = selves.begin; self < selves.end; ++self) {
        // Particles that are far apart may share a cell; others are no further apart than a cell is wide.
        const Vec3 position = search.positionOf(self);
        if (!((position - search.origin).array().abs() < 1.5 * reach).all()) search.look(position);
        if (rows.places.size() < rows.used + room) rows.places.resize(rows.used + rows.used / 2 + room);
        const std::size_t length = search.sift(self, &rows.places[rows.used]);
        lengths[self - selves.begin] = static_cast<std::uint32_t>(length);
        rows.used += length;
        std::fill_n(&rows.places[rows.used], kRowPadding, self);
        rows.used += kRowPadding;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(findInReachHere);

void findInReach(const Candidates& candidates, const Neighbourhood& around, CellRange selves, double reach,
                 Surroundings& scratch, FoundRows& rows, std::uint32_t* lengths) {
    HWY_DYNAMIC_DISPATCH(findInReachHere)(candidates, around, selves, reach, scratch, rows, lengths);
}

}  // namespace engine

#endif
