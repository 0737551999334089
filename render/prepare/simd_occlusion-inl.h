// Openness of places on lanes, from the grid of openness.h. Included once per instruction set, by Highway's rules; the
// guard below is theirs.
#if defined(RENDER_SIMD_OCCLUSION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_OCCLUSION_INL_H_
#undef RENDER_SIMD_OCCLUSION_INL_H_
#else
#define RENDER_SIMD_OCCLUSION_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

HWY_INLINE V lerp(V a, V b, V part) {
    return hn::Add(hn::Mul(a, hn::Sub(splat(1.0F), part)), hn::Mul(b, part));
}

/// Numbers beside each other.
struct Pair {
    V first, second;
};

/// The pairs that begin at these places.
HWY_INLINE Pair pairsAt(const float* values, VI places) {
    const D d;
#if HWY_TARGET <= HWY_AVX2
    // Half as many loads as numbers, and loads are what gathering takes.
    const hn::Repartition<std::int64_t, D> wide;
    const auto pairs = [&](auto half) {
        return hn::BitCast(d, hn::GatherOffset(wide, reinterpret_cast<const std::int64_t*>(values),
                                               hn::ShiftLeft<2>(hn::PromoteTo(wide, half))));
    };
    const hn::Half<DI> half;
    const V lower = pairs(hn::LowerHalf(half, places));
    const V upper = pairs(hn::UpperHalf(half, places));
    return {hn::ConcatEven(d, upper, lower), hn::ConcatOdd(d, upper, lower)};
#else
    return {hn::GatherIndex(d, values, places), hn::GatherIndex(d, values, hn::Add(places, splatInt(1)))};
#endif
}

/// In sides of a cube, from the middle of the first; eye: what positions are relative to.
HWY_INLINE Vec3 gridPosition(const SkyVisibilityGrid& grid, glm::vec3 eye, const Vec3& position) {
    const V inverse = splat(1.0F / grid.side);
    const Vec3 from = splat(grid.origin - eye);
    return {hn::Mul(hn::Sub(position.x, from.x), inverse), hn::Mul(hn::Sub(position.y, from.y), inverse),
            hn::Mul(hn::Sub(position.z, from.z), inverse)};
}

/// Toward one of the six sides, at places as placeInGrid() has them; 1 outside of the grid.
HWY_INLINE V skyVisibilityInGrid(const SkyVisibilityGrid& grid, std::size_t side, const Vec3& at) {
    const DI di;
    const V zero = splat(0.0F);
    glm::vec3 ahead(0.0F);
    ahead[static_cast<int>(side / 2)] = side % 2 == 0 ? kSkySampleOffset : -kSkySampleOffset;
    const Vec3 place{hn::Add(at.x, splat(ahead.x)), hn::Add(at.y, splat(ahead.y)), hn::Add(at.z, splat(ahead.z))};
    const auto within = [&](V corner, int count) {
        return hn::And(hn::Ge(corner, zero), hn::Lt(corner, splat(static_cast<float>(count - 1))));
    };
    const V x = hn::Floor(place.x);
    const V y = hn::Floor(place.y);
    const V z = hn::Floor(place.z);
    const M inGrid = hn::And(within(x, grid.cells.x), hn::And(within(y, grid.cells.y), within(z, grid.cells.z)));
    const auto whole = [&](V corner) { return hn::ConvertTo(di, hn::IfThenElseZero(inGrid, corner)); };
    const VI columns = splatInt(grid.cells.x);
    const VI first = hn::Add(whole(x), hn::Mul(columns, hn::Add(whole(y), hn::Mul(splatInt(grid.cells.y), whole(z)))));
    const V partX = hn::Sub(place.x, x);
    const auto pairAt = [&](int off) {
        const Pair pair = pairsAt(grid.values[side].data(), hn::Add(first, splatInt(off)));
        return lerp(pair.first, pair.second, partX);
    };
    const int row = grid.cells.x;
    const int slice = row * grid.cells.y;
    const V partY = hn::Sub(place.y, y);
    const V open =
        lerp(lerp(pairAt(0), pairAt(row), partY), lerp(pairAt(slice), pairAt(slice + row), partY), hn::Sub(place.z, z));
    return hn::IfThenElse(inGrid, open, splat(1.0F));
}

/// open(d) of view.h for a unit vector d along the world's axes: the sum over the axes of d's squared component times the
/// visibility on its side. plus, minus: the visibilities along +x, +y, +z and along -x, -y, -z.
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
