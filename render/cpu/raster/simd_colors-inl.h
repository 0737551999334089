// Colors on lanes: their arithmetic, what the ground fades into, and sRGB; shared by the kernels that color pixels.
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

HWY_INLINE V mixedBy(float a, float b, V part) {
    return hn::Add(splat(a), hn::Mul(part, splat(b - a)));
}

HWY_INLINE Vec3 mixedBy(glm::vec3 a, glm::vec3 b, V part) {
    return {mixedBy(a.x, b.x, part), mixedBy(a.y, b.y, part), mixedBy(a.z, b.z, part)};
}

HWY_INLINE Vec3 plus(const Vec3& a, const Vec3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Vec3 times(const Vec3& a, const Vec3& b) {
    return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}

HWY_INLINE Vec3 times(const Vec3& a, V b) {
    return {hn::Mul(a.x, b), hn::Mul(a.y, b), hn::Mul(a.z, b)};
}

/// a toward b.
HWY_INLINE Vec3 mixedBy(const Vec3& a, const Vec3& b, V part) {
    const V rest = hn::Sub(splat(1.0F), part);
    return plus(times(a, rest), times(b, part));
}

/// How much of the background shows through the ground at these places (view.h).
HWY_INLINE V fadeAt(const Vec3& position, glm::vec3 center, float distance) {
    const Vec3 off = times(plus(position, splat(-center)), splat(1.0F / distance));
    const V square = dot(off, off);
    const V fade = hn::Min(hn::Mul(square, square), splat(1.0e30F));
    return hn::Div(fade, hn::Add(splat(1.0F), fade));
}

// 1.055 c^(1/2.4) - 0.055 is a smooth function of y = c^(1/4), two square roots away: a polynomial of degree 5 in y
// through the Chebyshev nodes of [0.0031308^(1/4), 1] is within 0.0025 of a 255th. tests/render/encode_test.cpp
// measures it.
/// sRGB in 255ths, to the nearest; linear: from 0 to 1.
HWY_INLINE VI encoded(V linear) {
    const V square = hn::Sqrt(linear);
    const V y = hn::Sqrt(square);
    const auto curve = [&](float high, float middle, float low) {
        return hn::Add(hn::Add(hn::Mul(splat(high), linear), hn::Mul(splat(middle), square)), splat(low));
    };
    const V bent =
        hn::Add(curve(0.2727522F, 1.2442140F, -0.0616297F), hn::Mul(y, curve(-0.0627590F, -0.5575557F, 0.1649740F)));
    const V value = hn::IfThenElse(hn::Le(linear, splat(0.0031308F)), hn::Mul(splat(12.92F), linear), bent);
    return hn::ConvertTo(DI(), hn::Add(hn::Mul(value, splat(255.0F)), splat(0.5F)));
}

/// As PixelColor (shade.h) has them; color: linear, from 0 to 1.
HWY_INLINE void storePacked(const Vec3& color, std::uint32_t* pixels) {
    const VI packed =
        hn::Or(encoded(color.x), hn::Or(hn::ShiftLeft<8>(encoded(color.y)), hn::ShiftLeft<16>(encoded(color.z))));
    const hn::RebindToUnsigned<D> du;
    hn::StoreU(hn::BitCast(du, packed), du, pixels);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
