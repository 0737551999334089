// Packing of hits with Highway; shading_points.cpp unpacks them. This file is compiled once per instruction set.
#include "render/cpu/metaballs/metaball_hits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/metaballs/metaball_hits.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Clamps numbers to [0, most] and rounds them to integers.
VI roundToInt(V value, float most) {
    return hn::ConvertTo(DI(), clamp(value, 0.0F, most) + splat(0.5F));
}

/// Octahedral encoding: the octahedron |x| + |y| + |z| = 1 is unfolded onto the square of x and y.
VI packNormal(const Vec3& n) {
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    const V length = hn::Abs(n.x) + hn::Abs(n.y) + hn::Abs(n.z);
    // A normal of length zero, where the field has no slope, becomes +z.
    const V scale = hn::IfThenElseZero(length > zero, one / length);
    const V x = n.x * scale;
    const V y = n.y * scale;
    const auto folded = [&](V other, V own) { return hn::CopySign(one - hn::Abs(other), own); };
    const M isBelow = n.z < zero;
    const auto bits = [&](V at) { return roundToInt((at + one) * splat(32767.5F), 65535.0F); };
    return hn::Or(bits(hn::IfThenElse(isBelow, folded(y, x), x)),
                  hn::ShiftLeft<16>(bits(hn::IfThenElse(isBelow, folded(x, y), y))));
}

VI packColor(const Vec3& color) {
    const auto bits = [](V value, float most) {
        return roundToInt(hn::Sqrt(clamp(value, 0.0F, 1.0F)) * splat(most), most);
    };
    return hn::Or(hn::Or(bits(color.x, 2047.0F), hn::ShiftLeft<11>(bits(color.y, 2047.0F))),
                  hn::ShiftLeft<22>(bits(color.z, 1023.0F)));
}

VI packSky(const Vec3& sky) {
    const auto bits = [](V value) { return roundToInt(value * splat(1023.0F), 1023.0F); };
    return hn::Or(hn::Or(bits(sky.x), hn::ShiftLeft<10>(bits(sky.y))), hn::ShiftLeft<20>(bits(sky.z)));
}

void packHits(const MetaballScene& scene, const RayBlock& block, PackedHit* packed) {
    const DI di;
    for (std::size_t first = 0; first < block.count; first += hn::Lanes(di)) {
        const V depth = load(&block.depth[first]);
        const auto isHit = hn::RebindMask(di, depth >= splat(0.0F));
        // A hit at the eye itself must not have the depth 0, which stands for no hit.
        const VI depthBits = hn::BitCast(di, hn::Max(depth, splat(1e-30F)));
        const VI normal = packNormal(toWorld(scene.frame, loadVec3(block.normal, first)));
        const VI color = packColor(loadVec3(block.color, first));
        const VI sky = scene.hasSky ? packSky(loadVec3(block.sky, first)) : hn::Zero(di);
        hn::StoreInterleaved4(hn::IfThenElseZero(isHit, depthBits), hn::IfThenElseZero(isHit, normal),
                              hn::IfThenElseZero(isHit, color), hn::IfThenElseZero(isHit, sky), di,
                              reinterpret_cast<std::int32_t*>(&packed[first]));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(packHits);

void packHits(const MetaballScene& scene, const RayBlock& block, PackedHit* packed) {
    HWY_DYNAMIC_DISPATCH(packHits)(scene, block, packed);
}

}  // namespace render

#endif
