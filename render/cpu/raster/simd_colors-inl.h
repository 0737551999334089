// Colors on SIMD vectors: interpolation, how the ground fades into the background, and sRGB encoding. Included by the
// kernels that color pixels, once per instruction set by Highway's rules; the guard below is theirs.
#if defined(RENDER_SIMD_COLORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_COLORS_INL_H_
#undef RENDER_SIMD_COLORS_INL_H_
#else
#define RENDER_SIMD_COLORS_INL_H_
#endif

#include <cstdint>

#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

HWY_INLINE V lerp(float a, float b, V t) {
    return splat(a) + t * splat(b - a);
}

HWY_INLINE Vec3 lerp(glm::vec3 a, glm::vec3 b, V t) {
    return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t)};
}

HWY_INLINE Vec3 lerp(const Vec3& a, const Vec3& b, V t) {
    return a * (splat(1.0F) - t) + b * t;
}

/// How much of the background shows through the ground at these positions: fade / (1 + fade) of view.h.
HWY_INLINE V groundFade(const Vec3& position, glm::vec3 center, float fadeDistance) {
    const Vec3 offset = (position - splat(center)) * splat(1.0F / fadeDistance);
    const V square = dot(offset, offset);
    const V fade = hn::Min(square * square, splat(1.0e30F));
    return fade / (splat(1.0F) + fade);
}

/// sRGB in steps of 1/255, rounded to the nearest; linear: from 0 to 1.
///
/// 1.055 c^(1/2.4) - 0.055 is a smooth function of y = c^(1/4), two square roots away: a polynomial of degree 5 in y
/// through the Chebyshev nodes of [0.0031308^(1/4), 1] is within 0.0025 of a step. tests/render/encode_test.cpp
/// measures it.
HWY_INLINE VI encodeSrgb(V linear) {
    const V square = hn::Sqrt(linear);
    const V y = hn::Sqrt(square);
    const auto quadratic = [&](float high, float middle, float low) {
        return splat(high) * linear + splat(middle) * square + splat(low);
    };
    const V curve =
        quadratic(0.2727522F, 1.2442140F, -0.0616297F) + y * quadratic(-0.0627590F, -0.5575557F, 0.1649740F);
    const V value = hn::IfThenElse(linear <= splat(0.0031308F), splat(12.92F) * linear, curve);
    return hn::ConvertTo(DI(), value * splat(255.0F) + splat(0.5F));
}

/// Writes a vector of pixels as PixelColor (shade.h) has them. @param color  linear, from 0 to 1
HWY_INLINE void storeSrgb(const Vec3& color, std::uint32_t* pixels) {
    const VI packed = hn::Or(encodeSrgb(color.x),
                             hn::Or(hn::ShiftLeft<8>(encodeSrgb(color.y)), hn::ShiftLeft<16>(encodeSrgb(color.z))));
    const hn::RebindToUnsigned<D> du;
    hn::StoreU(hn::BitCast(du, packed), du, pixels);
}

HWY_INLINE Vec3 clampUnit(const Vec3& color) {
    return {clamp(color.x, 0.0F, 1.0F), clamp(color.y, 0.0F, 1.0F), clamp(color.z, 0.0F, 1.0F)};
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
