// Compiled once per instruction set. Most candidates are out of reach, unpredictably so: vectors of them are packed
// without a branch.
#include "engine/list_search.h"

#include <algorithm>
#include <bit>

#include "engine/packings.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Which of the candidates from one on are within reach, a bit each.
struct Reach {
    static constexpr hn::CappedTag<double, kSearchOverhang> kTag{};
    using V = hn::Vec<decltype(kTag)>;

    const Candidates& candidates;
    V x, y, z, reachSq;

    unsigned from(std::uint32_t other) const {
        const V dx = hn::Sub(x, hn::LoadU(kTag, &candidates.x[other]));
        const V dy = hn::Sub(y, hn::LoadU(kTag, &candidates.y[other]));
        const V dz = hn::Sub(z, hn::LoadU(kTag, &candidates.z[other]));
        const V distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(kTag, hn::Lt(distanceSq, reachSq), bits);
        return bits[0];
    }
};

std::uint32_t* findInReachHere(const Candidates& candidates, const Neighbourhood& around, std::uint32_t self,
                               double reachSq, std::uint32_t* out) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(Reach::kTag));
    const Reach reach{candidates, hn::Set(Reach::kTag, candidates.x[self]), hn::Set(Reach::kTag, candidates.y[self]),
                      hn::Set(Reach::kTag, candidates.z[self]), hn::Set(Reach::kTag, reachSq)};
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        for (std::uint32_t other = range.begin; other < range.end; other += lanes) {
            unsigned within = reach.from(other);
            if (range.end - other < lanes) within &= (1U << (range.end - other)) - 1U;
            if (self - other < lanes) within &= ~(1U << (self - other));
            for (std::uint32_t quad = 0; quad < lanes; quad += kQuad, within >>= kQuad) {
                const unsigned chosen = within & ((1U << kQuad) - 1U);
                Packing packed = kPackings[chosen];
                for (std::uint32_t& place : packed) place += other + quad;
                std::copy(packed.begin(), packed.end(), out);
                out += std::popcount(chosen);
            }
        }
    }
    return out;
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(findInReachHere);

std::uint32_t* findInReach(const Candidates& candidates, const Neighbourhood& around, std::uint32_t self,
                           double reachSq, std::uint32_t* out) {
    return HWY_DYNAMIC_DISPATCH(findInReachHere)(candidates, around, self, reachSq, out);
}

}  // namespace engine

#endif
