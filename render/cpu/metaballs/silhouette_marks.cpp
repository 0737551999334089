// A part of a row at a time, on lanes; this file is compiled once per instruction set.
#include "render/cpu/metaballs/silhouette_marks.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/silhouette_marks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

std::array<std::uint32_t, kTilePixels> marksOf(const BorderedDepths& depths, float jump,
                                               const std::array<MarkedSide, 4>& sides) {
    const D d;
    const hn::RebindToUnsigned<D> du;
    std::array<std::uint32_t, kTilePixels> marks;
    for (std::size_t place = 0; place < kTilePixels; place += hn::Lanes(d)) {
        const float* at = &depths.values[BorderedDepths::indexOf(static_cast<std::uint8_t>(place))];
        const V own = hn::LoadU(d, at);
        auto found = hn::Zero(du);
        for (const MarkedSide& side : sides) {
            const M differs = hn::Gt(hn::Abs(hn::Sub(hn::LoadU(d, at + side.step), own)), splat(jump));
            found = hn::Or(found, hn::IfThenElseZero(hn::RebindMask(du, differs), hn::Set(du, side.mark)));
        }
        hn::StoreU(found, du, &marks[place]);
    }
    return marks;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(marksOf);

std::array<std::uint32_t, kTilePixels> marksOf(const BorderedDepths& depths, float jump,
                                               const std::array<MarkedSide, 4>& sides) {
    return HWY_DYNAMIC_DISPATCH(marksOf)(depths, jump, sides);
}

}  // namespace render

#endif
