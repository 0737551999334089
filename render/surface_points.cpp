// shaders/surface.glsl on lanes; this file is compiled once per instruction set.
#include "render/surface_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/surface_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/lane_fours-inl.h"
#include "render/lane_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// What is known of a group of points so far.
struct Placed {
    V depth;
    Vec3 normal;

    void set(M where, V itsDepth, const Vec3& itsNormal) {
        depth = hn::IfThenElse(where, itsDepth, depth);
        normal = chosen(where, itsNormal, normal);
    }
};

Vec3 normalized(const Vec3& v) {
    const V scale = hn::Div(all(1.0F), hn::Sqrt(dotted(v, v)));
    return {hn::Mul(v.x, scale), hn::Mul(v.y, scale), hn::Mul(v.z, scale)};
}

void placeOnSpheres(const Surfaces& surfaces, const WorldRay& ray, V inverseSquare, VI seen, M where, Placed& placed) {
    static_assert(sizeof(ViewSphere) == 4 * sizeof(float));
    const auto* records = reinterpret_cast<const float*>(surfaces.spheres.data());
    const VI first = hn::ShiftLeft<2>(hn::IfThenElseZero(hn::RebindMask(DI(), where), seen));
    const Fours sphere = foursFrom(records, first);
    const Vec3 toCenter{hn::Sub(sphere.x, ray.origin.x), hn::Sub(sphere.y, ray.origin.y),
                        hn::Sub(sphere.z, ray.origin.z)};
    const V radius = sphere.w;
    const V closest = hn::Mul(dotted(toCenter, ray.direction), inverseSquare);
    const Vec3 off{hn::Sub(hn::Mul(closest, ray.direction.x), toCenter.x),
                   hn::Sub(hn::Mul(closest, ray.direction.y), toCenter.y),
                   hn::Sub(hn::Mul(closest, ray.direction.z), toCenter.z)};
    const V zero = all(0.0F);
    const V inside = hn::Max(hn::Sub(hn::Mul(radius, radius), dotted(off, off)), zero);
    const V depth = hn::Max(hn::Sub(closest, hn::Sqrt(hn::Mul(inside, inverseSquare))), zero);
    placed.set(where, depth, normalized(along(off, hn::Sub(depth, closest), ray.direction)));
}

/// The component along an axis (0, 1, 2) of each lane.
V component(const Vec3& v, VI axis) {
    const M isX = laneMask(hn::Eq(axis, allOf(0)));
    const M isY = laneMask(hn::Eq(axis, allOf(1)));
    return hn::IfThenElse(isX, v.x, hn::IfThenElse(isY, v.y, v.z));
}

void placeOnBoxes(const Surfaces& surfaces, const WorldRay& ray, VI seen, M where, Placed& placed) {
    static_assert(sizeof(BoxObstacle) == 9 * sizeof(float));
    const DI di;
    const auto* records = reinterpret_cast<const float*>(surfaces.boxes.data());
    const VI id = hn::IfThenElseZero(hn::RebindMask(di, where), hn::Sub(seen, allOf(kSeesBox)));
    const VI side = hn::And(id, allOf(7));
    const VI axis = hn::ShiftRight<1>(side);
    const auto isPlus = hn::Eq(hn::And(side, allOf(1)), allOf(0));
    // Nine floats a box: minimum, maximum, color.
    const VI box = hn::Mul(hn::ShiftRight<4>(id), allOf(9));
    const VI corner = hn::Add(hn::Add(box, axis), hn::IfThenElse(isPlus, allOf(3), allOf(0)));
    const V bound = hn::Sub(hn::GatherIndex(D(), records, corner), component(uniform(surfaces.frame.eye), axis));
    const V slope = component(ray.direction, axis);
    const V safe = hn::IfThenElse(hn::Gt(hn::Abs(slope), all(1.0e-20F)), slope, all(1.0e-20F));
    const V reached = clamped(hn::Div(hn::Sub(bound, component(ray.origin, axis)), safe), 0.0F, 1.0e30F);
    const V depth = hn::IfThenElse(laneMask(hn::Eq(hn::And(id, allOf(8)), allOf(0))), reached, all(0.0F));
    const V sign = hn::IfThenElse(laneMask(isPlus), all(1.0F), all(-1.0F));
    const auto onAxis = [&](int which) { return hn::IfThenElseZero(laneMask(hn::Eq(axis, allOf(which))), sign); };
    placed.set(where, depth, {onAxis(0), onAxis(1), onAxis(2)});
}

/// Sixteen bits as a number from -1 to 1.
V folded(VI bits) {
    return hn::Sub(hn::Mul(hn::ConvertTo(D(), hn::And(bits, allOf(0xffff))), all(1.0F / 32767.5F)), all(1.0F));
}

void placeOnField(const Surfaces& surfaces, VI seen, M where, Placed& placed) {
    static_assert(sizeof(FieldSample) == 4 * sizeof(std::uint32_t));
    const DI di;
    const auto* records = reinterpret_cast<const float*>(surfaces.field.data());
    const VI place = hn::IfThenElseZero(hn::RebindMask(di, where), hn::Sub(seen, allOf(kSeesField)));
    const Fours sample = foursFrom(records, hn::ShiftLeft<2>(place));
    const V depth = sample.x;
    const VI bits = hn::BitCast(di, sample.y);
    V x = folded(bits);
    V y = folded(hn::ShiftRight<16>(bits));
    const V z = hn::Sub(hn::Sub(all(1.0F), hn::Abs(x)), hn::Abs(y));
    const V under = hn::Max(hn::Neg(z), all(0.0F));
    const auto unfolded = [&](V v) { return hn::Sub(v, hn::IfThenElse(hn::Ge(v, all(0.0F)), under, hn::Neg(under))); };
    x = unfolded(x);
    y = unfolded(y);
    placed.set(where, depth, normalized({x, y, z}));
}

void placeOnGround(const WorldRay& ray, float height, M where, Placed& placed) {
    const V depth = hn::Div(hn::Sub(all(height), ray.origin.y), ray.direction.y);
    placed.set(where, depth, uniform({0.0F, 1.0F, 0.0F}));
}

void placeGroup(const Surfaces& surfaces, std::size_t place, SurfacePoints& points) {
    const D d;
    const VI seen = hn::Load(DI(), &points.seen[place]);
    const CameraFrame& frame = surfaces.frame;
    const WorldRay ray = worldRay(frame, planeAt(frame, hn::Load(d, &points.x[place]), hn::Load(d, &points.y[place])));
    const V inverseSquare = hn::Div(all(1.0F), dotted(ray.direction, ray.direction));
    Placed placed{all(0.0F), uniform(-surfaces.toLight)};
    const M isField = laneMask(hn::Gt(seen, allOf(kSeesField - 1)));
    const M isBox = hn::AndNot(isField, laneMask(hn::Gt(seen, allOf(kSeesBox - 1))));
    const M isSphere = hn::AndNot(isField, hn::AndNot(isBox, laneMask(hn::Gt(seen, allOf(-1)))));
    const M isGround = laneMask(hn::Eq(seen, allOf(kSeesGround)));
    if (!hn::AllFalse(d, isGround)) placeOnGround(ray, surfaces.ground.value_or(0.0F), isGround, placed);
    if (!hn::AllFalse(d, isSphere)) placeOnSpheres(surfaces, ray, inverseSquare, seen, isSphere, placed);
    if (!hn::AllFalse(d, isBox)) placeOnBoxes(surfaces, ray, seen, isBox, placed);
    if (!hn::AllFalse(d, isField)) placeOnField(surfaces, seen, isField, placed);
    const Vec3 position = along(ray.origin, placed.depth, ray.direction);
    hn::Store(position.x, d, &points.position[0][place]);
    hn::Store(position.y, d, &points.position[1][place]);
    hn::Store(position.z, d, &points.position[2][place]);
    hn::Store(placed.normal.x, d, &points.normal[0][place]);
    hn::Store(placed.normal.y, d, &points.normal[1][place]);
    hn::Store(placed.normal.z, d, &points.normal[2][place]);
    const V width = all(frame.pixelWidth());
    hn::Store(frame.perspective ? hn::Mul(width, placed.depth) : width, d, &points.pixelWidth[place]);
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
