// Sky visibility at points, one per SIMD lane, interpolated in the grid of ambient_occlusion.h. Included once per
// instruction set by Highway's rules, from which the guard below comes.
#if defined(RENDER_SIMD_OCCLUSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_OCCLUSION_INL_H_
#undef RENDER_SIMD_OCCLUSION_INL_H_
#else
#define RENDER_SIMD_OCCLUSION_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/lighting/ambient_occlusion.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

HWY_INLINE V lerp(V a, V b, V t) {
    return a * (splat(1.0F) - t) + b * t;
}

/// Positions in the grid in units of a cube's side, measured from the center of the first cube.
/// @param eye  the point that `position` is relative to
HWY_INLINE Vec3 gridPosition(const SkyVisibilityGrid& grid, glm::vec3 eye, const Vec3& position) {
    return (position - splat(grid.origin - eye)) * splat(1.0F / grid.side);
}

/// Sky visibility toward one of the six sides of a cube, interpolated in the grid: O of shading_model.h, section 3. It
/// is 1 outside of the grid.
/// @param side  index into SkyVisibility
/// @param at  position as gridPosition() returns it
HWY_INLINE V skyVisibilityInGrid(const SkyVisibilityGrid& grid, std::size_t side, const Vec3& at) {
    const D d;
    const DI di;
    glm::vec3 ahead(0.0F);
    ahead[static_cast<int>(side / 2)] = side % 2 == 0 ? kSkySampleOffset : -kSkySampleOffset;
    const Vec3 point = at + splat(ahead);
    const Vec3 corner{hn::Floor(point.x), hn::Floor(point.y), hn::Floor(point.z)};
    const Vec3 part = point - corner;
    const auto within = [](V value, int count) {
        return hn::And(value >= splat(0.0F), value < splat(static_cast<float>(count - 1)));
    };
    const M inGrid = hn::And(within(corner.x, grid.cells.x),
                             hn::And(within(corner.y, grid.cells.y), within(corner.z, grid.cells.z)));
    const auto whole = [&](V value) { return hn::ConvertTo(di, hn::IfThenElseZero(inGrid, value)); };
    const int row = grid.cells.x;
    const int slice = row * grid.cells.y;
    const VI first = whole(corner.x) + splatInt(row) * whole(corner.y) + splatInt(slice) * whole(corner.z);
    const auto valueAt = [&](int offset) {
        return hn::GatherIndex(d, grid.values[side].data(), first + splatInt(offset));
    };
    const auto alongX = [&](int offset) { return lerp(valueAt(offset), valueAt(offset + 1), part.x); };
    const V value =
        lerp(lerp(alongX(0), alongX(row), part.y), lerp(alongX(slice), alongX(slice + row), part.y), part.z);
    return hn::IfThenElse(inGrid, value, splat(1.0F));
}

/// skyVisibility(d) of shading_model.h in the direction of unit vectors d along the world's axes.
/// @param plus  the values O along +x, +y, +z
/// @param minus  the values O along -x, -y, -z
HWY_INLINE V skyVisibilityToward(const Vec3& direction, const Vec3& plus, const Vec3& minus) {
    const Vec3 value{hn::IfThenElse(direction.x > splat(0.0F), plus.x, minus.x),
                     hn::IfThenElse(direction.y > splat(0.0F), plus.y, minus.y),
                     hn::IfThenElse(direction.z > splat(0.0F), plus.z, minus.z)};
    return dot(direction * direction, value);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
