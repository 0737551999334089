// view.h's shading model on lanes, term by term; this file is compiled once per instruction set.
#include "render/cpu/shading/shade.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/shading/shade.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/simd_colors-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// A group of points as they are shaded.
struct ShadedPoints {
    Vec3 normal, albedo;
    Vec3 toEye;    // unit length
    V isParticle;  // 1 on particles, 0 on all else
    V lit;         // share of the light that arrives
    V open;        // along the normal
    V openBehind;  // against it
    V openMirrored;
};

V positive(V value) {
    return hn::Max(value, splat(0.0F));
}

Vec3 skyToward(const Ambient& ambient, V up) {
    return mixedBy(ambient.ground, ambient.sky, hn::Add(splat(0.5F), hn::Mul(splat(0.5F), up)));
}

Vec3 fresnel(const Surface& surface, const Vec3& albedo, V cosine) {
    const V specular = splat(surface.specular);
    Vec3 headOn{specular, specular, specular};
    if (surface.metal > 0.0F) headOn = mixedBy(headOn, albedo, splat(surface.metal));
    const V away = hn::Sub(splat(1.0F), positive(cosine));
    const V square = hn::Mul(away, away);
    const V part = hn::Mul(hn::Mul(square, square), away);
    const Vec3 rest{hn::Sub(splat(1.0F), headOn.x), hn::Sub(splat(1.0F), headOn.y), hn::Sub(splat(1.0F), headOn.z)};
    return plus(headOn, times(rest, part));
}

/// Without the light's color and what of it arrives.
Vec3 glint(const Shading& shading, const ShadedPoints& at) {
    const Vec3 sum = plus(splat(shading.light.toLight), at.toEye);
    const Vec3 halfway = times(sum, hn::Div(splat(1.0F), hn::Sqrt(dot(sum, sum))));
    V peak = positive(dot(at.normal, halfway));
    float gloss = 1.0F;
    for (int squaring = 0; squaring < shading.surface.glossExponent; ++squaring) {
        peak = hn::Mul(peak, peak);
        gloss *= 2.0F;
    }
    const V strength = hn::Mul(splat((gloss + 8.0F) / 8.0F), peak);
    return times(fresnel(shading.surface, at.albedo, dot(at.toEye, halfway)), strength);
}

Vec3 surroundingsToward(const Surroundings& around, V up) {
    const Vec3 above = mixedBy(around.horizon, around.top, hn::Mul(up, hn::Sub(splat(2.0F), up)));
    const Vec3 below = mixedBy(around.horizon, around.bottom, hn::Min(splat(1.0F), hn::Mul(splat(-4.0F), up)));
    return select(hn::Gt(up, splat(0.0F)), above, below);
}

Vec3 mirrored(const Shading& shading, const ShadedPoints& at) {
    const V cosine = dot(at.normal, at.toEye);
    const V up = hn::Sub(hn::Mul(hn::Mul(splat(2.0F), cosine), at.normal.y), at.toEye.y);
    const Vec3 seen = times(fresnel(shading.surface, at.albedo, cosine), surroundingsToward(shading.surroundings, up));
    return times(seen, hn::Mul(splat(shading.surface.reflection), at.openMirrored));
}

/// What a matt body sends back of light and sky.
Vec3 bodyColor(const Shading& shading, const ShadedPoints& at) {
    const Surface& surface = shading.surface;
    const Vec3 lightColor = splat(shading.light.color);
    const V facing = dot(at.normal, splat(shading.light.toLight));
    V cosine = positive(facing);
    if (surface.roughness > 0.0F) {
        const V seen = hn::Add(hn::Add(cosine, positive(dot(at.normal, at.toEye))), splat(0.2F));
        const V dust = hn::Sub(hn::Div(splat(2.2F), seen), splat(1.0F));
        cosine = hn::Mul(cosine, hn::Add(splat(1.0F), hn::Mul(at.isParticle, hn::Mul(splat(surface.roughness), dust))));
    }
    Vec3 ambient = skyToward(shading.ambient, at.normal.y);
    if (shading.ambient.occlusion > 0.0F)
        ambient = times(ambient,
                        hn::Sub(splat(1.0F), hn::Mul(splat(shading.ambient.occlusion), hn::Sub(splat(1.0F), at.open))));
    Vec3 light = plus(ambient, times(lightColor, hn::Mul(cosine, at.lit)));
    if (surface.translucency > 0.0F) {
        const V behind = hn::Add(splat(0.25F), positive(hn::Neg(facing)));
        const Vec3 through = plus(skyToward(shading.ambient, hn::Neg(at.normal.y)), times(lightColor, behind));
        const V share = hn::Mul(hn::Mul(at.isParticle, splat(surface.translucency)), at.openBehind);
        light = plus(light, times(through, share));
    }
    Vec3 body = at.albedo;
    if (surface.absorption > 0.0F) {
        const V deep = hn::Mul(splat(surface.absorption), hn::Sub(splat(1.0F), at.openBehind));
        body = mixedBy(body, times(body, body), hn::Mul(at.isParticle, deep));
    }
    const Vec3 color = times(body, light);
    if (surface.metal == 0.0F) return color;
    return times(color, hn::Sub(splat(1.0F), hn::Mul(at.isParticle, splat(surface.metal))));
}

/// Smooth, for what is brighter than 0.7; below 1, and whiter the brighter it was.
Vec3 shoulder(const Vec3& color) {
    const V one = splat(1.0F);
    const V peak = hn::Max(color.x, hn::Max(color.y, color.z));
    const V kept = hn::Sub(one, hn::Div(splat(0.09F), hn::Max(hn::Sub(peak, splat(0.4F)), splat(0.3F))));
    const V over = hn::Mul(splat(0.06F), hn::Sub(peak, kept));
    const V white = hn::Sub(one, hn::Div(one, hn::Add(one, over)));
    const Vec3 bent = mixedBy(times(color, hn::Div(kept, hn::Max(peak, splat(0.7F)))), {kept, kept, kept}, white);
    return select(hn::Gt(peak, splat(0.7F)), bent, color);
}

Vec3 surfaceColor(const Shading& shading, const ShadedPoints& at) {
    const Surface& surface = shading.surface;
    Vec3 color = bodyColor(shading, at);
    // Obstacles and ground are matt.
    if (!hn::AllFalse(D(), hn::Gt(at.isParticle, splat(0.0F)))) {
        if (surface.specular > 0.0F || surface.metal > 0.0F) {
            const auto faces = hn::Gt(dot(at.normal, splat(shading.light.toLight)), splat(0.0F));
            const V share = hn::IfThenElseZero(faces, hn::Mul(at.isParticle, at.lit));
            color = plus(color, times(times(splat(shading.light.color), glint(shading, at)), share));
        }
        if (surface.reflection > 0.0F) color = plus(color, times(mirrored(shading, at), at.isParticle));
        if (surface.glow > 0.0F) {
            const V share = hn::Mul(at.isParticle, splat(surface.glow));
            color = plus(color, times(times(at.albedo, at.albedo), share));
        }
    }
    return shading.exposure > 0.0F ? shoulder(times(color, splat(shading.exposure))) : color;
}

Vec3 loaded(const std::array<std::array<float, kTilePixels>, 3>& values, std::size_t place) {
    const D d;
    return {hn::Load(d, &values[0][place]), hn::Load(d, &values[1][place]), hn::Load(d, &values[2][place])};
}

ShadedPoints shadedPoints(const Surfaces& surfaces, const SurfacePoints& points, const LightReach* reach, VI seen,
                          std::size_t place) {
    const D d;
    const V one = splat(1.0F);
    const CameraFrame& frame = surfaces.frame;
    const M isField = floatMask(hn::Gt(seen, splatInt(kSeesField - 1)));
    const M isOwn = floatMask(hn::And(hn::Gt(seen, splatInt(-1)), hn::Lt(seen, splatInt(surfaces.firstObstacle))));
    const M isParticle = hn::Or(isField, isOwn);
    const Vec3 direction =
        worldRay(frame, imagePointAt(frame, hn::Load(d, &points.x[place]), hn::Load(d, &points.y[place]))).direction;
    const Vec3 toEye = times(direction, hn::Div(splat(-1.0F), hn::Sqrt(dot(direction, direction))));
    const V lit = reach != nullptr ? hn::Load(d, &reach->light[place]) : one;
    const V sky = reach != nullptr ? hn::Load(d, &reach->sky[place]) : one;
    const Vec3 open = surfaces.opens ? loaded(points.open, place) : Vec3{one, one, one};
    return {loaded(points.normal, place),
            loaded(points.albedo, place),
            toEye,
            hn::IfThenElseZero(isParticle, one),
            lit,
            hn::IfThenElse(isParticle, open.x, sky),
            open.y,
            open.z};
}

void shade(const Shading& shading, const Surfaces& surfaces, const SurfacePoints& points, const LightReach* reach,
           PointColors& colors) {
    const D d;
    const Background& background = shading.background;
    const float height = static_cast<float>(surfaces.frame.height);
    for (std::size_t place = 0; place < points.count; place += hn::Lanes(d)) {
        const VI seen = hn::Load(DI(), &points.seen[place]);
        Vec3 color = surfaceColor(shading, shadedPoints(surfaces, points, reach, seen, place));
        const M isGround = floatMask(hn::Eq(seen, splatInt(kSeesGround)));
        const M isBackground = floatMask(hn::Eq(seen, splatInt(kSeesBackground)));
        if (!hn::AllFalse(d, hn::Or(isGround, isBackground))) {
            const V down = hn::Mul(hn::Load(d, &points.y[place]), splat(1.0F / height));
            const V fade = hn::IfThenElseZero(
                isGround, fadeAt(loaded(points.position, place), shading.groundCenter, shading.fadeDistance));
            const V share = hn::IfThenElse(isBackground, splat(1.0F), fade);
            color = mixedBy(color, mixedBy(background.top, background.bottom, down), share);
        }
        hn::Store(clamp(color.x, 0.0F, 1.0F), d, &colors.rgb[0][place]);
        hn::Store(clamp(color.y, 0.0F, 1.0F), d, &colors.rgb[1][place]);
        hn::Store(clamp(color.z, 0.0F, 1.0F), d, &colors.rgb[2][place]);
    }
}

glm::vec3 unoccludedGround(const Shading& shading, glm::vec3 albedo) {
    const V one = splat(1.0F);
    const Vec3 up = splat({0.0F, 1.0F, 0.0F});
    const Vec3 color = surfaceColor(shading, {up, splat(albedo), up, splat(0.0F), one, one, one, one});
    return {hn::GetLane(color.x), hn::GetLane(color.y), hn::GetLane(color.z)};
}

void packColors(const PointColors& colors, PixelColor* pixels) {
    const D d;
    for (std::size_t place = 0; place < kTilePixels; place += hn::Lanes(d)) {
        // A mean of ones may be a little more.
        const auto channel = [&](std::size_t k) { return hn::Min(hn::Load(d, &colors.rgb[k][place]), splat(1.0F)); };
        storePacked({channel(0), channel(1), channel(2)}, pixels + place);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(shade);
HWY_EXPORT(unoccludedGround);
HWY_EXPORT(packColors);

Shading shadingOf(const View& view) {
    Shading shading{view.light, view.ambient, view.surface, view.surroundings, view.exposure, view.background};
    shading.light.toLight = lightBasis(view.light.toLight).toLight;
    const Ground ground = view.ground.value_or(Ground{});
    shading.groundCenter = ground.center - view.camera.eye;
    shading.fadeDistance = ground.fadeDistance;
    return shading;
}

void shade(const Shading& shading, const Surfaces& surfaces, const SurfacePoints& points, const LightReach* reach,
           PointColors& colors) {
    HWY_DYNAMIC_DISPATCH(shade)(shading, surfaces, points, reach, colors);
}

glm::vec3 unoccludedGround(const Shading& shading, glm::vec3 albedo) {
    return HWY_DYNAMIC_DISPATCH(unoccludedGround)(shading, albedo);
}

void packColors(const PointColors& colors, PixelColor* pixels) {
    HWY_DYNAMIC_DISPATCH(packColors)(colors, pixels);
}

}  // namespace render

#endif
