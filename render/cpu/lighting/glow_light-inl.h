// The light of glowing particles at points, one per SIMD lane, interpolated in the grid of glow_light.h. Included by
// light_visibility.cpp once per instruction set by Highway's rules, from which the guard below comes.
#if defined(RENDER_GLOW_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_GLOW_LIGHT_INL_H_
#undef RENDER_GLOW_LIGHT_INL_H_
#else
#define RENDER_GLOW_LIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include "render/cpu/lighting/receivers-inl.h"
#include "render/cpu/raster/simd_loads-inl.h"
#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/lighting/glow_light.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The values of the grid on one side of the cubes around each point, interpolated.
/// @param first  index of the first of the eight cubes around each point
/// @param part   place of the point between them, 0 to 1 along each axis
/// @param side   the side of each lane
HWY_INLINE Vec3 glowOnSide(const GlowGrid& grid, VI first, const Vec3& part, VI side) {
    const auto* numbers = reinterpret_cast<const float*>(grid.values.data());
    const int row = grid.cells.x;
    const int slice = row * grid.cells.y;
    const V one = splat(1.0F);
    Vec3 sum = splat(glm::vec3(0.0F));
    for (int corner = 0; corner < 8; ++corner) {
        const bool isRight = (corner & 1) != 0;
        const bool isUpper = (corner & 2) != 0;
        const bool isFarther = (corner & 4) != 0;
        const V weight =
            (isRight ? part.x : one - part.x) * (isUpper ? part.y : one - part.y) * (isFarther ? part.z : one - part.z);
        const VI cell = first + splatInt((isRight ? 1 : 0) + (isUpper ? row : 0) + (isFarther ? slice : 0));
        const Float4 light = gather4(numbers, hn::ShiftLeft<2>(cell * splatInt(6) + side));
        sum = sum + Vec3{light.x, light.y, light.z} * weight;
    }
    return sum;
}

/// glowLight(n) of shading_model.h; 0 outside of the grid.
/// @param eye  the point that `position` is relative to
HWY_INLINE Vec3 glowLightAt(const GlowGrid& grid, glm::vec3 eye, const Vec3& position, const Vec3& normal) {
    const Vec3 at = (position - splat(grid.origin - eye)) * splat(1.0F / grid.side);
    const Vec3 corner{hn::Floor(at.x), hn::Floor(at.y), hn::Floor(at.z)};
    const auto within = [](V value, int count) {
        return hn::And(value >= splat(0.0F), value < splat(static_cast<float>(count - 1)));
    };
    const M inGrid = hn::And(within(corner.x, grid.cells.x),
                             hn::And(within(corner.y, grid.cells.y), within(corner.z, grid.cells.z)));
    if (none(inGrid)) return splat(glm::vec3(0.0F));
    const auto whole = [&](V value) { return hn::ConvertTo(DI(), hn::IfThenElseZero(inGrid, value)); };
    const VI row = splatInt(grid.cells.x);
    const VI first = whole(corner.x) + row * (whole(corner.y) + splatInt(grid.cells.y) * whole(corner.z));
    const Vec3 part = at - corner;
    const auto along = [&](V component, int axis) {
        const auto isPlus = hn::RebindMask(DI(), component > splat(0.0F));
        const VI side = splatInt(2 * axis) + hn::IfThenElse(isPlus, splatInt(0), splatInt(1));
        return glowOnSide(grid, first, part, side) * (component * component);
    };
    const Vec3 light = along(normal.x, 0) + along(normal.y, 1) + along(normal.z, 2);
    return select(inGrid, light, splat(glm::vec3(0.0F)));
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
