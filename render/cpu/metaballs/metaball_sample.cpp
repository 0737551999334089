// Packing of normals and colors with Highway; the unpacking is in surface_points.cpp. This file is compiled once per
// instruction set.
#include "render/cpu/metaballs/metaball_sample.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/metaball_sample.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// A number from 0 to `most`, rounded to a whole one.
VI rounded(V value, float most) {
    return hn::ConvertTo(DI(), hn::Add(clamp(value, 0.0F, most), splat(0.5F)));
}

VI packedNormal(const Vec3& n) {
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    const V length = hn::Add(hn::Add(hn::Abs(n.x), hn::Abs(n.y)), hn::Abs(n.z));
    // Where the field has no slope: toward +z.
    const V scale = hn::IfThenElseZero(hn::Gt(length, zero), hn::Div(one, length));
    const V x = hn::Mul(n.x, scale);
    const V y = hn::Mul(n.y, scale);
    const auto under = [&](V other, V own) { return hn::CopySign(hn::Sub(one, hn::Abs(other)), own); };
    const M isUnder = hn::Lt(n.z, zero);
    const auto bits = [&](V at) { return rounded(hn::Mul(hn::Add(at, one), splat(32767.5F)), 65535.0F); };
    return hn::Or(bits(hn::IfThenElse(isUnder, under(y, x), x)),
                  hn::ShiftLeft<16>(bits(hn::IfThenElse(isUnder, under(x, y), y))));
}

VI packedRoots(V red, V green, V blue) {
    const auto bits = [](V value, float most) {
        return rounded(hn::Mul(hn::Sqrt(clamp(value, 0.0F, 1.0F)), splat(most)), most);
    };
    return hn::Or(hn::Or(bits(red, 2047.0F), hn::ShiftLeft<11>(bits(green, 2047.0F))),
                  hn::ShiftLeft<22>(bits(blue, 1023.0F)));
}

void packBlock(const CameraFrame& frame, const RayBlock& block, bool skyVisibility, FieldSample* packed) {
    const D d;
    const DI di;
    const Vec3 right = splat(frame.right);
    const Vec3 up = splat(frame.up);
    const Vec3 forward = splat(frame.forward);
    for (std::size_t k = 0; k < block.count; k += hn::Lanes(d)) {
        const auto of = [k](const std::array<float, kBlockRays>& values) { return hn::Load(D(), &values[k]); };
        const V depth = of(block.depth);
        const auto isHit = hn::RebindMask(di, hn::Ge(depth, splat(0.0F)));
        const V x = of(block.normal[0]);
        const V y = of(block.normal[1]);
        const V z = of(block.normal[2]);
        const Vec3 normal{hn::Add(hn::Add(hn::Mul(x, right.x), hn::Mul(y, up.x)), hn::Mul(z, forward.x)),
                          hn::Add(hn::Add(hn::Mul(x, right.y), hn::Mul(y, up.y)), hn::Mul(z, forward.y)),
                          hn::Add(hn::Add(hn::Mul(x, right.z), hn::Mul(y, up.z)), hn::Mul(z, forward.z))};
        // A hit at the eye itself still has to differ from no hit.
        const VI bits = hn::BitCast(di, hn::Max(depth, splat(1e-30F)));
        const VI color = packedRoots(of(block.color[0]), of(block.color[1]), of(block.color[2]));
        const auto share = [&](std::size_t which) {
            return rounded(hn::Mul(of(block.open[which]), splat(1023.0F)), 1023.0F);
        };
        VI open = hn::Zero(di);
        if (skyVisibility) open = hn::Or(hn::Or(share(0), hn::ShiftLeft<10>(share(1))), hn::ShiftLeft<20>(share(2)));
        hn::StoreInterleaved4(hn::IfThenElseZero(isHit, bits), hn::IfThenElseZero(isHit, packedNormal(normal)),
                              hn::IfThenElseZero(isHit, color), hn::IfThenElseZero(isHit, open), di,
                              reinterpret_cast<std::int32_t*>(&packed[k]));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(packBlock);

void packBlock(const CameraFrame& frame, const RayBlock& block, bool skyVisibility, FieldSample* packed) {
    HWY_DYNAMIC_DISPATCH(packBlock)(frame, block, skyVisibility, packed);
}

}  // namespace render

#endif
