// The shading model (render/picture/shading_model.h) with Highway, term by term, one point per lane; this file is
// compiled once per instruction set.
#include "render/cpu/shading/shade.h"

#include <array>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/shading/dither.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/shading/shade.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

#ifndef RENDER_SHADE_DITHER
#define RENDER_SHADE_DITHER
namespace render {
namespace {

/// The thresholds of a tile's pixels row by row, and in the order of kZCurve. A tile is a whole number of patterns.
struct TileDither {
    alignas(64) std::array<float, kTilePixels> ofPixels{}, alongCurve{};

    constexpr TileDither() {
        static_assert(kTileSize % kDitherSide == 0);
        for (unsigned k = 0; k < kTilePixels; ++k) {
            ofPixels[k] = ditherThreshold(k % kTileSize, k / kTileSize);
            alongCurve[k] = ditherThreshold(kZCurve[k] % kTileSize, kZCurve[k] / kTileSize);
        }
    }
};

constexpr TileDither kDither;

}  // namespace
}  // namespace render
#endif

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

/// How much of the background shows through the ground at these positions: fade / (1 + fade) of shading_model.h.
HWY_INLINE V groundFade(const Vec3& position, glm::vec3 center, float fadeDistance) {
    const Vec3 offset = (position - splat(center)) * splat(1.0F / fadeDistance);
    const V square = dot(offset, offset);
    const V fade = hn::Min(square * square, splat(1.0e30F));
    return fade / (splat(1.0F) + fade);
}

/// sRGB encoding of linear values from 0 to 1, in steps of 1/255.
///
/// 1.055 c^(1/2.4) - 0.055 is a smooth function of y = c^(1/4), two square roots away: a polynomial of degree 5 in y
/// through the Chebyshev nodes of [0.0031308^(1/4), 1] is within 0.0025 of a step. tests/render/encode_test.cpp
/// measures it.
HWY_INLINE V encodeSrgb(V linear) {
    const V square = hn::Sqrt(linear);
    const V y = hn::Sqrt(square);
    const auto quadratic = [&](float high, float middle, float low) {
        return splat(high) * linear + splat(middle) * square + splat(low);
    };
    const V curve =
        quadratic(0.2727522F, 1.2442140F, -0.0616297F) + y * quadratic(-0.0627590F, -0.5575557F, 0.1649740F);
    const V value = hn::IfThenElse(linear <= splat(0.0031308F), splat(12.92F) * linear, curve);
    return value * splat(255.0F);
}

HWY_INLINE Vec3 clampUnit(const Vec3& color) {
    return {clamp(color.x, 0.0F, 1.0F), clamp(color.y, 0.0F, 1.0F), clamp(color.z, 0.0F, 1.0F)};
}

/// Clamps linear colors to [0, 1] and encodes them as sRGB, in steps of 1/255.
HWY_INLINE Vec3 encodedSteps(const Vec3& linear) {
    const Vec3 color = clampUnit(linear);
    return {encodeSrgb(color.x), encodeSrgb(color.y), encodeSrgb(color.z)};
}

/// Rounds encoded colors to whole steps by the pixels' thresholds, see dither.h, and writes them to a vector of pixels.
HWY_INLINE void storeSteps(const Vec3& steps, V thresholds, PixelColor* pixels) {
    const auto rounded = [&](V channel) { return hn::ConvertTo(DI(), channel + thresholds); };
    const VI packed =
        hn::Or(rounded(steps.x), hn::Or(hn::ShiftLeft<8>(rounded(steps.y)), hn::ShiftLeft<16>(rounded(steps.z))));
    const hn::RebindToUnsigned<D> du;
    hn::StoreU(hn::BitCast(du, packed), du, pixels);
}

/// What the shading of a vector of points depends on.
struct ShadingInputs {
    Vec3 normal, albedo;
    Vec3 toEye;         // direction to the eye, unit length
    V isParticle;       // 1 on particles, 0 elsewhere
    V lightVisibility;  // share of the light that reaches the point, 0 to 1
    V skyAlong;         // sky visibility along the normal, 0 to 1
    V skyBehind;        // sky visibility against the normal
    V skyMirrored;      // sky visibility along the mirrored ray
    Vec3 glow;          // light of glowing particles; read only where some glow
};

V positive(V value) {
    return hn::Max(value, splat(0.0F));
}

/// Ambient light from a direction d: skyLight(d) of shading_model.h. @param up  the component d.y
Vec3 skyToward(const Ambient& ambient, V up) {
    return lerp(ambient.ground, ambient.sky, splat(0.5F) + splat(0.5F) * up);
}

Vec3 fresnel(const Surface& surface, const Vec3& albedo, V cosine) {
    const V one = splat(1.0F);
    Vec3 headOn = splat(glm::vec3(surface.specular));
    if (surface.metal > 0.0F) headOn = lerp(headOn, albedo, splat(surface.metal));
    const V away = one - positive(cosine);
    const V square = away * away;
    return headOn + (Vec3{one, one, one} - headOn) * (square * square * away);
}

/// The highlight, without the light's color and visibility.
Vec3 highlight(const Shading& shading, const ShadingInputs& at) {
    const Vec3 halfway = normalize(splat(shading.light.toLight) + at.toEye);
    V peak = positive(dot(at.normal, halfway));
    float gloss = 1.0F;
    for (int squaring = 0; squaring < shading.surface.glossExponent; ++squaring) {
        peak = peak * peak;
        gloss *= 2.0F;
    }
    return fresnel(shading.surface, at.albedo, dot(at.toEye, halfway)) * (splat((gloss + 8.0F) / 8.0F) * peak);
}

/// What a mirror shows in a direction d: surroundings(d) of shading_model.h. @param up  the component d.y
Vec3 surroundingsToward(const Surroundings& around, V up) {
    const Vec3 above = lerp(around.horizon, around.top, up * (splat(2.0F) - up));
    const Vec3 below = lerp(around.horizon, around.bottom, hn::Min(splat(1.0F), splat(-4.0F) * up));
    return select(up > splat(0.0F), above, below);
}

Vec3 mirrored(const Shading& shading, const ShadingInputs& at) {
    const V cosine = dot(at.normal, at.toEye);
    const V up = splat(2.0F) * cosine * at.normal.y - at.toEye.y;
    const Vec3 reflected = fresnel(shading.surface, at.albedo, cosine) * surroundingsToward(shading.surroundings, up);
    return reflected * (splat(shading.surface.reflection) * at.skyMirrored);
}

/// Light from behind that brightens the outlines.
Vec3 rim(const Shading& shading, const ShadingInputs& at) {
    const V one = splat(1.0F);
    const V away = one - positive(dot(at.normal, at.toEye));
    const V square = away * away;
    V strength = square * square * (splat(0.5F) + splat(0.5F) * at.normal.y);
    if (shading.ambient.occlusion > 0.0F)
        strength = strength * (one - splat(shading.ambient.occlusion) * (one - at.skyAlong));
    return splat(shading.light.rim) * strength;
}

/// The body's color times ambient, diffuse and transmitted light and that of particles.
/// @param reaching  color of the light that reaches the point
Vec3 bodyColor(const Shading& shading, const ShadingInputs& at, const Vec3& reaching) {
    const Surface& surface = shading.surface;
    const V one = splat(1.0F);
    const Vec3 lightColor = splat(shading.light.color);
    const V facing = dot(at.normal, splat(shading.light.toLight));
    V cosine = positive(facing);
    if (surface.roughness > 0.0F) {
        const V dust = splat(2.2F) / (cosine + positive(dot(at.normal, at.toEye)) + splat(0.2F)) - one;
        cosine = cosine * (one + at.isParticle * (splat(surface.roughness) * dust));
    }
    Vec3 ambient = skyToward(shading.ambient, at.normal.y);
    if (shading.ambient.occlusion > 0.0F)
        ambient = ambient * (one - splat(shading.ambient.occlusion) * (one - at.skyAlong));
    Vec3 light = ambient + reaching * (cosine * at.lightVisibility);
    if (surface.translucency > 0.0F) {
        const V behind = splat(0.25F) + positive(hn::Neg(facing));
        const Vec3 through = skyToward(shading.ambient, hn::Neg(at.normal.y)) + lightColor * behind;
        light = light + through * (at.isParticle * splat(surface.translucency) * at.skyBehind);
    }
    if (surface.glow > 0.0F) light = light + at.glow;
    Vec3 body = at.albedo;
    if (surface.absorption > 0.0F) {
        const V depth = splat(surface.absorption) * (one - at.skyBehind);
        body = lerp(body, body * body, at.isParticle * depth);
    }
    const Vec3 color = body * light;
    if (surface.metal == 0.0F) return color;
    return color * (one - at.isParticle * splat(surface.metal));
}

/// Compresses colors that are too bright to display: shoulder(c) of shading_model.h.
Vec3 shoulder(const Vec3& color) {
    const V one = splat(1.0F);
    const V peak = hn::Max(color.x, hn::Max(color.y, color.z));
    const V bentPeak = one - splat(0.09F) / hn::Max(peak - splat(0.4F), splat(0.3F));
    const V white = one - one / (one + splat(0.06F) * (peak - bentPeak));
    const Vec3 bent = lerp(color * (bentPeak / hn::Max(peak, splat(0.7F))), {bentPeak, bentPeak, bentPeak}, white);
    return select(peak > splat(0.7F), bent, color);
}

/// What a transparent body shows of its own, and mirrors in addition to the terms of `color`.
struct OwnLight {
    V bodyShare;
    Vec3 added;
    Vec3 tint;  // of the light that reaches the point
};

/// The sum of all terms of `color` in shading_model.h, before it is clamped.
/// @param own  null if the points are opaque
Vec3 surfaceColor(const Shading& shading, const ShadingInputs& at, const OwnLight* own = nullptr) {
    const Surface& surface = shading.surface;
    Vec3 reaching = splat(shading.light.color);
    if (own != nullptr) reaching = reaching * own->tint;
    Vec3 color = bodyColor(shading, at, reaching);
    if (own != nullptr) color = color * own->bodyShare + own->added;
    // Obstacles and the ground are matt: they have none of the following terms.
    if (!none(at.isParticle > splat(0.0F))) {
        if (surface.specular > 0.0F || surface.metal > 0.0F) {
            const M isFacing = dot(at.normal, splat(shading.light.toLight)) > splat(0.0F);
            V share = hn::IfThenElseZero(isFacing, at.isParticle * at.lightVisibility);
            if (shading.ambient.occlusion > 0.0F)
                share = share * (splat(1.0F) - splat(shading.ambient.occlusion) * (splat(1.0F) - at.skyMirrored));
            color = color + reaching * highlight(shading, at) * share;
        }
        if (shading.light.rim != glm::vec3(0.0F)) color = color + rim(shading, at) * at.isParticle;
        if (surface.reflection > 0.0F) color = color + mirrored(shading, at) * at.isParticle;
        if (surface.glow > 0.0F) color = color + at.albedo * at.albedo * (at.isParticle * splat(surface.glow));
    }
    return shading.exposure > 0.0F ? shoulder(color * splat(shading.exposure)) : color;
}

/// Directions to the eye, or to where a ray comes from that transparent bodies have refracted, unit length.
Vec3 towardEye(const CameraFrame& frame, const ShadingPoints& points, const TransparentShading* transparency,
               std::size_t first) {
    if (transparency != nullptr) return loadVec3(transparency->direction, first) * splat(-1.0F);
    const Vec3 direction =
        worldRay(frame, imagePointAt(frame, load(&points.x[first]), load(&points.y[first]))).direction;
    return direction * (splat(-1.0F) / hn::Sqrt(dot(direction, direction)));
}

ShadingInputs loadInputs(const ShadingGeometry& geometry, const ShadingPoints& points,
                         const LightVisibility* visibility, const Vec3& toEye, VI hitId, std::size_t first) {
    const V one = splat(1.0F);
    const M isMetaball = floatMask(hitId > splatInt(kHitMetaballs - 1));
    const M isParticleSphere = floatMask(hn::And(hitId > splatInt(-1), hitId < splatInt(geometry.firstObstacle)));
    const M isParticle = hn::Or(isMetaball, isParticleSphere);
    const V light = visibility != nullptr ? load(&visibility->light[first]) : one;
    const V sky = visibility != nullptr ? load(&visibility->sky[first]) : one;
    const Vec3 particleSky = geometry.hasSky ? loadVec3(points.sky, first) : Vec3{one, one, one};
    return {loadVec3(points.normal, first),
            loadVec3(points.albedo, first),
            toEye,
            hn::IfThenElseZero(isParticle, one),
            light,
            hn::IfThenElse(isParticle, particleSky.x, sky),
            particleSky.y,
            particleSky.z,
            visibility != nullptr && visibility->hasGlow ? loadVec3(visibility->glow, first) : splat(glm::vec3(0.0F))};
}

/// Linear colors of the background at heights y on the picture, in pixels from its top.
HWY_INLINE Vec3 backgroundAt(const ShadingGeometry& geometry, const Shading& shading, V y) {
    return lerp(shading.background.top, shading.background.bottom,
                y * splat(1.0F / static_cast<float>(geometry.frame.height)));
}

void shade(const Shading& shading, const ShadingGeometry& geometry, const ShadingPoints& points,
           const LightVisibility* visibility, const TransparentShading* transparency, PointColors& colors) {
    const D d;
    for (std::size_t first = 0; first < points.count; first += hn::Lanes(d)) {
        const VI hitId = loadInt(&points.hitId[first]);
        const Vec3 toEye = towardEye(geometry.frame, points, transparency, first);
        const ShadingInputs at = loadInputs(geometry, points, visibility, toEye, hitId, first);
        Vec3 color;
        if (transparency == nullptr) {
            color = surfaceColor(shading, at);
        } else {
            const Vec3 tint =
                transparency->tint != nullptr ? loadVec3(*transparency->tint, first) : splat(glm::vec3(1.0F));
            const OwnLight own{load(&transparency->bodyShare[first]), loadVec3(transparency->added, first), tint};
            color = surfaceColor(shading, at, &own);
        }
        const M isGround = floatMask(hitId == splatInt(kHitGround));
        const M isBackground = floatMask(hitId == splatInt(kHitBackground));
        if (!none(hn::Or(isGround, isBackground))) {
            const V fade = hn::IfThenElseZero(
                isGround, groundFade(loadVec3(points.position, first), shading.groundCenter, shading.fadeDistance));
            const V share = hn::IfThenElse(isBackground, splat(1.0F), fade);
            color = lerp(color, backgroundAt(geometry, shading, load(&points.y[first])), share);
        }
        storeVec3(clampUnit(color), colors.rgb, first);
    }
}

/// Color of ground that nothing occludes. A matt surface looks the same from everywhere, so that the direction to the
/// eye may be any.
glm::vec3 openGroundColor(const Shading& shading, glm::vec3 albedo) {
    const V one = splat(1.0F);
    const Vec3 up = splat({0.0F, 1.0F, 0.0F});
    const Vec3 color =
        surfaceColor(shading, {up, splat(albedo), up, splat(0.0F), one, one, one, one, splat(glm::vec3(0.0F))});
    return {hn::GetLane(color.x), hn::GetLane(color.y), hn::GetLane(color.z)};
}

Vec3 openGroundAt(const ShadingGeometry& geometry, const Shading& shading, V x, V y) {
    const Ray ray = worldRay(geometry.frame, imagePointAt(geometry.frame, x, y));
    const V depth = (splat(geometry.ground.value_or(0.0F)) - ray.origin.y) / ray.direction.y;
    const Vec3 position = pointOnRay(ray.origin, depth, ray.direction);
    return lerp(splat(shading.openGround), backgroundAt(geometry, shading, y),
                groundFade(position, shading.groundCenter, shading.fadeDistance));
}

void colorBackgroundTile(const ShadingGeometry& geometry, const Shading& shading, bool isGround,
                         const TileTarget& target) {
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    const auto middlesFrom = [](int first) { return hn::Iota(D(), static_cast<float>(first) + 0.5F); };
    const auto rowOf = [&](int row) { return target.first + static_cast<std::size_t>(row) * target.rowLength; };
    const auto thresholdsOf = [](int row, int column) {
        return load(&kDither.ofPixels[static_cast<std::size_t>(row * kTileSize + column)]);
    };
    for (int row = 0; row < kTileSize; ++row) {
        const V y = splat(static_cast<float>(target.corner.y + row) + 0.5F);
        if (!isGround) {
            // The background has one color in each row of pixels.
            const Vec3 steps = encodedSteps(backgroundAt(geometry, shading, y));
            for (int column = 0; column < kTileSize; column += lanes)
                storeSteps(steps, thresholdsOf(row, column), rowOf(row) + column);
            continue;
        }
        for (int column = 0; column < kTileSize; column += lanes) {
            const Vec3 color = openGroundAt(geometry, shading, middlesFrom(target.corner.x + column), y);
            storeSteps(encodedSteps(color), thresholdsOf(row, column), rowOf(row) + column);
        }
    }
}

void encodeColors(const PointColors& colors, Rounding rounding, PixelColor* pixels) {
    for (std::size_t first = 0; first < kTilePixels; first += hn::Lanes(D())) {
        const V thresholds = rounding == Rounding::dithered ? load(&kDither.alongCurve[first]) : splat(0.5F);
        storeSteps(encodedSteps(loadVec3(colors.rgb, first)), thresholds, pixels + first);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(shade);
HWY_EXPORT(openGroundColor);
HWY_EXPORT(colorBackgroundTile);
HWY_EXPORT(encodeColors);

Shading shadingOf(const View& view) {
    Shading shading{view.light, view.ambient, view.surface, view.surroundings, view.exposure, view.background};
    shading.light.toLight = lightBasis(view.light.toLight).toLight;
    const Ground ground = view.ground.value_or(Ground{});
    shading.groundCenter = ground.center - view.camera.eye;
    shading.fadeDistance = ground.fadeDistance;
    shading.openGround = HWY_DYNAMIC_DISPATCH(openGroundColor)(shading, ground.color);
    return shading;
}

void shade(const Shading& shading, const ShadingGeometry& geometry, const ShadingPoints& points,
           const LightVisibility* visibility, const TransparentShading* transparency, PointColors& colors) {
    HWY_DYNAMIC_DISPATCH(shade)(shading, geometry, points, visibility, transparency, colors);
}

void colorBackgroundTile(const ShadingGeometry& geometry, const Shading& shading, bool isGround,
                         const TileTarget& target) {
    HWY_DYNAMIC_DISPATCH(colorBackgroundTile)(geometry, shading, isGround, target);
}

void encodeColors(const PointColors& colors, Rounding rounding, PixelColor* pixels) {
    HWY_DYNAMIC_DISPATCH(encodeColors)(colors, rounding, pixels);
}

}  // namespace render

#endif
