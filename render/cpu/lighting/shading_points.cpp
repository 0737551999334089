// Where rays meet what they see, and what it looks like there, on lanes; this file is compiled once per instruction
// set.
#include "render/cpu/lighting/shading_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/lighting/shading_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_loads-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// What is known of a group of points so far.
struct Placed {
    V depth;
    Vec3 normal, albedo, open;

    void set(M where, V itsDepth, const Vec3& itsNormal, const Vec3& itsAlbedo) {
        depth = hn::IfThenElse(where, itsDepth, depth);
        normal = select(where, itsNormal, normal);
        albedo = select(where, itsAlbedo, albedo);
    }
};

/// A group of rays and what they see.
struct PixelGroup {
    WorldRay ray;
    V inverseSquare;  // of the direction's length
    VI seen;

    /// Of these lanes, counted from the first of its kind; 0 of the others.
    VI indexOf(M where, std::int32_t first) const {
        return hn::IfThenElseZero(hn::RebindMask(DI(), where), hn::Sub(seen, splatInt(first)));
    }

    /// The ray as it leaves a mirror, of unit length.
    Vec3 mirrored(const Vec3& normal) const {
        const V scale = hn::Sqrt(inverseSquare);
        const V twice = hn::Mul(splat(-2.0F), hn::Mul(scale, dot(ray.direction, normal)));
        return pointOnRay(
            {hn::Mul(scale, ray.direction.x), hn::Mul(scale, ray.direction.y), hn::Mul(scale, ray.direction.z)}, twice,
            normal);
    }
};

Vec3 normalized(const Vec3& v) {
    const V scale = hn::Div(splat(1.0F), hn::Sqrt(dot(v, v)));
    return {hn::Mul(v.x, scale), hn::Mul(v.y, scale), hn::Mul(v.z, scale)};
}

template <int kFirst, int kBits>
V bitsAsShare(VI word) {
    constexpr std::int32_t kMost = (1 << kBits) - 1;
    const VI bits = hn::And(hn::ShiftRight<kFirst>(word), splatInt(kMost));
    return hn::Mul(hn::ConvertTo(D(), bits), splat(1.0F / static_cast<float>(kMost)));
}

/// What field_sample.h and drawn_spheres.h pack: square roots in 11, 11 and 10 bits, finer than an 8-bit sRGB step.
Vec3 unpackedColor(VI word) {
    const V red = bitsAsShare<0, 11>(word);
    const V green = bitsAsShare<11, 11>(word);
    const V blue = bitsAsShare<22, 10>(word);
    return {hn::Mul(red, red), hn::Mul(green, green), hn::Mul(blue, blue)};
}

Vec3 unpackedOpen(VI word) {
    return {bitsAsShare<0, 10>(word), bitsAsShare<10, 10>(word), bitsAsShare<20, 10>(word)};
}

/// Sum over the axes of the squared component times the value on its side.
V openAlong(const Vec3& direction, const Vec3& plus, const Vec3& minus) {
    const auto part = [](V component, V above, V below) {
        const V value = hn::IfThenElse(hn::Gt(component, splat(0.0F)), above, below);
        return hn::Mul(hn::Mul(component, component), value);
    };
    return hn::Add(hn::Add(part(direction.x, plus.x, minus.x), part(direction.y, plus.y, minus.y)),
                   part(direction.z, plus.z, minus.z));
}

template <typename Record>
Float4 recordsAt(std::span<const Record> records, VI index) {
    static_assert(sizeof(Record) == 4 * sizeof(float));
    return gather4(reinterpret_cast<const float*>(records.data()), hn::ShiftLeft<2>(index));
}

void placeOnSpheres(const Surfaces& surfaces, const PixelGroup& group, M where, Placed& placed) {
    const WorldRay& ray = group.ray;
    const VI index = group.indexOf(where, 0);
    const Float4 sphere = recordsAt(surfaces.spheres, index);
    const Vec3 toCenter{hn::Sub(sphere.x, ray.origin.x), hn::Sub(sphere.y, ray.origin.y),
                        hn::Sub(sphere.z, ray.origin.z)};
    const V radius = sphere.w;
    const V closest = hn::Mul(dot(toCenter, ray.direction), group.inverseSquare);
    const Vec3 off{hn::Sub(hn::Mul(closest, ray.direction.x), toCenter.x),
                   hn::Sub(hn::Mul(closest, ray.direction.y), toCenter.y),
                   hn::Sub(hn::Mul(closest, ray.direction.z), toCenter.z)};
    const V zero = splat(0.0F);
    const V inside = hn::Max(hn::Sub(hn::Mul(radius, radius), dot(off, off)), zero);
    const V depth = hn::Max(hn::Sub(closest, hn::Sqrt(hn::Mul(inside, group.inverseSquare))), zero);
    const Vec3 normal = normalized(pointOnRay(off, hn::Sub(depth, closest), ray.direction));
    const Float4 look = recordsAt(surfaces.looks, index);
    const auto word = [](V bits) { return hn::BitCast(DI(), bits); };
    placed.set(where, depth, normal, unpackedColor(word(look.x)));
    if (!surfaces.opens) return;
    const Vec3 plus = unpackedOpen(word(look.y));
    const Vec3 minus = unpackedOpen(word(look.z));
    const Vec3 open{openAlong(normal, plus, minus), openAlong(normal, minus, plus),
                    openAlong(group.mirrored(normal), plus, minus)};
    placed.open = select(where, open, placed.open);
}

/// The component along an axis (0, 1, 2) of each lane.
V component(const Vec3& v, VI axis) {
    const M isX = floatMask(hn::Eq(axis, splatInt(0)));
    const M isY = floatMask(hn::Eq(axis, splatInt(1)));
    return hn::IfThenElse(isX, v.x, hn::IfThenElse(isY, v.y, v.z));
}

void placeOnBoxes(const Surfaces& surfaces, const PixelGroup& group, M where, Placed& placed) {
    static_assert(sizeof(BoxObstacle) == 9 * sizeof(float));
    const WorldRay& ray = group.ray;
    const auto* records = reinterpret_cast<const float*>(surfaces.boxes.data());
    const VI id = group.indexOf(where, kSeesBox);
    const VI side = hn::And(id, splatInt(7));
    const VI axis = hn::ShiftRight<1>(side);
    const auto isPlus = hn::Eq(hn::And(side, splatInt(1)), splatInt(0));
    // Nine floats a box: minimum, maximum, color.
    const VI box = hn::Mul(hn::ShiftRight<4>(id), splatInt(9));
    const VI corner = hn::Add(hn::Add(box, axis), hn::IfThenElse(isPlus, splatInt(3), splatInt(0)));
    const V bound = hn::Sub(hn::GatherIndex(D(), records, corner), component(splat(surfaces.frame.eye), axis));
    // The ray of an outline's middle may run along the face.
    const V slope = component(ray.direction, axis);
    const V safe = hn::IfThenElse(hn::Gt(hn::Abs(slope), splat(1.0e-20F)), slope, splat(1.0e-20F));
    const V reached = clamp(hn::Div(hn::Sub(bound, component(ray.origin, axis)), safe), 0.0F, 1.0e30F);
    const V depth = hn::IfThenElse(floatMask(hn::Eq(hn::And(id, splatInt(8)), splatInt(0))), reached, splat(0.0F));
    const V sign = hn::IfThenElse(floatMask(isPlus), splat(1.0F), splat(-1.0F));
    const auto onAxis = [&](int which) { return hn::IfThenElseZero(floatMask(hn::Eq(axis, splatInt(which))), sign); };
    const auto channel = [&](int which) { return hn::GatherIndex(D(), records + 6 + which, box); };
    placed.set(where, depth, {onAxis(0), onAxis(1), onAxis(2)}, {channel(0), channel(1), channel(2)});
}

/// Sixteen bits as a number from -1 to 1.
V folded(VI bits) {
    return hn::Sub(hn::Mul(hn::ConvertTo(D(), hn::And(bits, splatInt(0xffff))), splat(1.0F / 32767.5F)), splat(1.0F));
}

Vec3 octahedralNormal(VI bits) {
    const V x = folded(bits);
    const V y = folded(hn::ShiftRight<16>(bits));
    const V z = hn::Sub(hn::Sub(splat(1.0F), hn::Abs(x)), hn::Abs(y));
    const V under = hn::Max(hn::Neg(z), splat(0.0F));
    const auto unfolded = [&](V v) {
        return hn::Sub(v, hn::IfThenElse(hn::Ge(v, splat(0.0F)), under, hn::Neg(under)));
    };
    return normalized({unfolded(x), unfolded(y), z});
}

void placeOnField(const Surfaces& surfaces, const PixelGroup& group, M where, Placed& placed) {
    const Float4 sample = recordsAt(surfaces.field, group.indexOf(where, kSeesField));
    const auto word = [](V bits) { return hn::BitCast(DI(), bits); };
    placed.set(where, sample.x, octahedralNormal(word(sample.y)), unpackedColor(word(sample.z)));
    if (surfaces.opens) placed.open = select(where, unpackedOpen(word(sample.w)), placed.open);
}

void placeOnGround(const Surfaces& surfaces, const PixelGroup& group, M where, Placed& placed) {
    const V below = hn::Sub(splat(surfaces.ground.value_or(0.0F)), group.ray.origin.y);
    placed.set(where, hn::Div(below, group.ray.direction.y), splat({0.0F, 1.0F, 0.0F}), splat(surfaces.groundColor));
}

void store(const Vec3& values, std::size_t place, std::array<std::array<float, kTilePixels>, 3>& to) {
    const D d;
    hn::Store(values.x, d, &to[0][place]);
    hn::Store(values.y, d, &to[1][place]);
    hn::Store(values.z, d, &to[2][place]);
}

void placeGroup(const Surfaces& surfaces, std::size_t place, SurfacePoints& points) {
    const D d;
    const CameraFrame& frame = surfaces.frame;
    PixelGroup group;
    group.seen = hn::Load(DI(), &points.seen[place]);
    group.ray = worldRay(frame, imagePointAt(frame, hn::Load(d, &points.x[place]), hn::Load(d, &points.y[place])));
    group.inverseSquare = hn::Div(splat(1.0F), dot(group.ray.direction, group.ray.direction));
    const Vec3 one{splat(1.0F), splat(1.0F), splat(1.0F)};
    Placed placed{splat(0.0F), splat(-surfaces.toLight), one, one};
    const M isField = floatMask(hn::Gt(group.seen, splatInt(kSeesField - 1)));
    const M isBox = hn::AndNot(isField, floatMask(hn::Gt(group.seen, splatInt(kSeesBox - 1))));
    const M isSphere = hn::AndNot(isField, hn::AndNot(isBox, floatMask(hn::Gt(group.seen, splatInt(-1)))));
    const M isGround = floatMask(hn::Eq(group.seen, splatInt(kSeesGround)));
    if (!hn::AllFalse(d, isGround)) placeOnGround(surfaces, group, isGround, placed);
    if (!hn::AllFalse(d, isSphere)) placeOnSpheres(surfaces, group, isSphere, placed);
    if (!hn::AllFalse(d, isBox)) placeOnBoxes(surfaces, group, isBox, placed);
    if (!hn::AllFalse(d, isField)) placeOnField(surfaces, group, isField, placed);
    hn::Store(placed.depth, d, &points.depth[place]);
    store(pointOnRay(group.ray.origin, placed.depth, group.ray.direction), place, points.position);
    store(placed.normal, place, points.normal);
    store(placed.albedo, place, points.albedo);
    if (surfaces.opens) store(placed.open, place, points.open);
}

// Whole groups: what lies beyond `count` is placed too, and nobody reads it.
void placePoints(const Surfaces& surfaces, SurfacePoints& points) {
    const std::size_t lanes = hn::Lanes(D());
    for (std::size_t place = points.count; place % lanes != 0; ++place) points.seen[place] = kSeesBackground;
    for (std::size_t place = 0; place < points.count; place += lanes) placeGroup(surfaces, place, points);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(placePoints);

void placePoints(const Surfaces& surfaces, SurfacePoints& points) {
    HWY_DYNAMIC_DISPATCH(placePoints)(surfaces, points);
}

}  // namespace render

#endif
