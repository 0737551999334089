// Compiled once per instruction set. Most candidates are out of reach, unpredictably so: every one is written, and the
// place to write moves on where it is within.
#include "engine/list_search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/list_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::uint32_t* findInReachHere(const Candidates& candidates, const Neighbourhood& around, std::uint32_t self,
                               double reachSq, std::uint32_t* out) {
    const hn::CappedTag<double, 8> tag;
    const std::size_t lanes = hn::Lanes(tag);
    const auto x = hn::Set(tag, candidates.x[self]);
    const auto y = hn::Set(tag, candidates.y[self]);
    const auto z = hn::Set(tag, candidates.z[self]);
    const auto limit = hn::Set(tag, reachSq);
    for (int r = 0; r < around.count; ++r) {
        const CellRange range = around.ranges[static_cast<std::size_t>(r)];
        std::uint32_t other = range.begin;
        for (; other + lanes <= range.end; other += static_cast<std::uint32_t>(lanes)) {
            const auto dx = hn::Sub(x, hn::LoadU(tag, &candidates.x[other]));
            const auto dy = hn::Sub(y, hn::LoadU(tag, &candidates.y[other]));
            const auto dz = hn::Sub(z, hn::LoadU(tag, &candidates.z[other]));
            const auto distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(tag, hn::Lt(distanceSq, limit), bits);
            for (std::uint32_t lane = 0; lane < lanes; ++lane) {
                *out = other + lane;
                out += (bits[0] >> lane) & (other + lane != self ? 1 : 0);
            }
        }
        for (; other < range.end; ++other) {
            const double dx = candidates.x[self] - candidates.x[other];
            const double dy = candidates.y[self] - candidates.y[other];
            const double dz = candidates.z[self] - candidates.z[other];
            *out = other;
            out += dx * dx + dy * dy + dz * dz < reachSq && other != self ? 1 : 0;
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
