// Shading points with Highway, one per lane; this file is compiled once per instruction set.
#include "render/cpu/lighting/shading_points.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/cpu/lighting/shading_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/cpu/raster/simd_loads-inl.h"
#include "render/prepare/cells/simd_rays-inl.h"
#include "render/prepare/lighting/simd_occlusion-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// The results for a vector of shading points, which are set for one kind of thing after another.
struct PointVector {
    V depth;
    Vec3 normal, albedo, sky;

    void set(M where, V newDepth, const Vec3& newNormal, const Vec3& newAlbedo) {
        depth = hn::IfThenElse(where, newDepth, depth);
        normal = select(where, newNormal, normal);
        albedo = select(where, newAlbedo, albedo);
    }
};

/// A vector of rays and what they hit.
struct HitRays {
    Ray ray;
    V inverseSquare;  // 1 / squared length of the ray's direction
    VI hitId;

    /// What the lanes of a mask hit, as an index counted from the first hit id of its kind; 0 in the other lanes.
    VI indexOf(M where, std::int32_t first) const {
        return hn::IfThenElseZero(hn::RebindMask(DI(), where), hitId - splatInt(first));
    }

    /// Unit vector in the direction of the ray after a mirror with this normal.
    Vec3 mirrored(const Vec3& normal) const {
        const V scale = hn::Sqrt(inverseSquare);
        return ray.direction * scale + normal * (splat(-2.0F) * (scale * dot(ray.direction, normal)));
    }
};

/// Unpacks a number from 0 to 1 from the kBits bits of a word that begin with bit kFirst.
template <int kFirst, int kBits>
V unpackUnit(VI word) {
    constexpr std::int32_t kMost = (1 << kBits) - 1;
    const VI bits = hn::And(hn::ShiftRight<kFirst>(word), splatInt(kMost));
    return hn::ConvertTo(D(), bits) * splat(1.0F / static_cast<float>(kMost));
}

/// Unpacks colors that are stored as square roots in 11, 11 and 10 bits, in steps finer than those of 8-bit sRGB.
Vec3 unpackColor(VI word) {
    const Vec3 root{unpackUnit<0, 11>(word), unpackUnit<11, 11>(word), unpackUnit<22, 10>(word)};
    return root * root;
}

Vec3 unpackSky(VI word) {
    return {unpackUnit<0, 10>(word), unpackUnit<10, 10>(word), unpackUnit<20, 10>(word)};
}

void addSpheres(const ShadingGeometry& geometry, const HitRays& hits, M where, PointVector& points) {
    const Ray& ray = hits.ray;
    const VI index = hits.indexOf(where, 0);
    const Float4 sphere = gather4(reinterpret_cast<const float*>(geometry.spheres.data()), hn::ShiftLeft<2>(index));
    const Vec3 toCenter = Vec3{sphere.x, sphere.y, sphere.z} - ray.origin;
    const V radius = sphere.w;
    // This is the intersection with a sphere of primary_hits.cpp, but along the world's axes, and with a normal.
    const V closest = dot(toCenter, ray.direction) * hits.inverseSquare;
    const Vec3 off = ray.direction * closest - toCenter;
    const V zero = splat(0.0F);
    const V inside = hn::Max(radius * radius - dot(off, off), zero);
    const V depth = hn::Max(closest - hn::Sqrt(inside * hits.inverseSquare), zero);
    const Vec3 normal = normalize(pointOnRay(off, depth - closest, ray.direction));
    const Words attributes = loadRecords(geometry.attributes, index);
    points.set(where, depth, normal, unpackColor(attributes.x));
    if (!geometry.hasSky) return;
    const Vec3 plus = unpackSky(attributes.y);
    const Vec3 minus = unpackSky(attributes.z);
    const Vec3 sky{skyVisibilityToward(normal, plus, minus), skyVisibilityToward(normal, minus, plus),
                   skyVisibilityToward(hits.mirrored(normal), plus, minus)};
    points.sky = select(where, sky, points.sky);
}

/// The component of each lane's vector along the lane's own axis (0, 1, 2).
V componentOf(const Vec3& v, VI axis) {
    const M isX = floatMask(axis == splatInt(0));
    const M isY = floatMask(axis == splatInt(1));
    return hn::IfThenElse(isX, v.x, hn::IfThenElse(isY, v.y, v.z));
}

void addBoxes(const ShadingGeometry& geometry, const HitRays& hits, M where, PointVector& points) {
    static_assert(sizeof(BoxObstacle) == 9 * sizeof(float));
    const Ray& ray = hits.ray;
    const auto* records = reinterpret_cast<const float*>(geometry.boxes.data());
    const VI id = hits.indexOf(where, kHitBox);
    const VI side = hn::And(id, splatInt(7));
    const VI axis = hn::ShiftRight<1>(side);
    const auto isPlus = hn::And(side, splatInt(1)) == splatInt(0);
    // A box is stored as nine floats: minimum, maximum, color.
    const VI box = hn::ShiftRight<4>(id) * splatInt(9);
    const VI corner = box + axis + hn::IfThenElse(isPlus, splatInt(3), splatInt(0));
    const V bound = hn::GatherIndex(D(), records, corner) - componentOf(splat(geometry.frame.eye), axis);
    // In a pixel at an outline the ray through the mean of the samples may run parallel to the face.
    const V slope = componentOf(ray.direction, axis);
    const V safe = hn::IfThenElse(hn::Abs(slope) > splat(1.0e-20F), slope, splat(1.0e-20F));
    const V reached = clamp((bound - componentOf(ray.origin, axis)) / safe, 0.0F, 1.0e30F);
    const M isOutside = floatMask(hn::And(id, splatInt(8)) == splatInt(0));
    const V sign = hn::IfThenElse(floatMask(isPlus), splat(1.0F), splat(-1.0F));
    const auto onAxis = [&](int which) { return hn::IfThenElseZero(floatMask(axis == splatInt(which)), sign); };
    const auto channel = [&](int which) { return hn::GatherIndex(D(), records + 6 + which, box); };
    points.set(where, hn::IfThenElseZero(isOutside, reached), {onAxis(0), onAxis(1), onAxis(2)},
               {channel(0), channel(1), channel(2)});
}

/// Unpacks normals that packNormal() of metaball_hits.cpp has packed.
Vec3 unpackNormal(VI bits) {
    const auto unpack = [](VI half) {
        return hn::ConvertTo(D(), hn::And(half, splatInt(0xffff))) * splat(1.0F / 32767.5F) - splat(1.0F);
    };
    const V x = unpack(bits);
    const V y = unpack(hn::ShiftRight<16>(bits));
    const V z = splat(1.0F) - hn::Abs(x) - hn::Abs(y);
    const V below = hn::Max(hn::Neg(z), splat(0.0F));
    const auto unfold = [&](V v) { return v - hn::IfThenElse(v >= splat(0.0F), below, hn::Neg(below)); };
    return normalize({unfold(x), unfold(y), z});
}

void addMetaballs(const ShadingGeometry& geometry, const HitRays& hits, M where, PointVector& points) {
    const Words hit = loadRecords(geometry.metaballs, hits.indexOf(where, kHitMetaballs));
    points.set(where, hn::BitCast(D(), hit.x), unpackNormal(hit.y), unpackColor(hit.z));
    if (geometry.hasSky) points.sky = select(where, unpackSky(hit.w), points.sky);
}

/// The vectors of a list at an index for each lane.
Vec3 gatherVec3(const std::vector<glm::vec3>& list, VI index) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const auto* values = reinterpret_cast<const float*>(list.data());
    const VI first = index + index + index;
    const auto component = [&](int axis) { return hn::GatherIndex(D(), values + axis, first); };
    return {component(0), component(1), component(2)};
}

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Weights of the second and the third corner of a triangle where a ray meets it, or at the triangle's border where the
/// ray passes by, and the place on the ray where it meets the triangle's plane (Moeller and Trumbore 1997).
struct CornerWeights {
    V second, third;
    V along;  ///< in lengths of the ray's direction

    CornerWeights(const Ray& ray, const Vec3& corner, const Vec3& toSecond, const Vec3& toThird) {
        const V zero = splat(0.0F);
        const V one = splat(1.0F);
        const Vec3 across = cross(ray.direction, toThird);
        const V volume = dot(toSecond, across);
        const V inverse = one / hn::IfThenElse(volume == zero, splat(1.0e-30F), volume);
        const Vec3 off = ray.origin - corner;
        const Vec3 aside = cross(off, toSecond);
        along = dot(toThird, aside) * inverse;
        second = clamp(dot(off, across) * inverse, 0.0F, 1.0F);
        third = clamp(dot(ray.direction, aside) * inverse, 0.0F, 1.0F);
        const V scale = one / hn::Max(one, second + third);
        second = second * scale;
        third = third * scale;
    }
};

void addMeshes(const ShadingGeometry& geometry, const HitRays& hits, M where, PointVector& points) {
    const DrawnMeshes& meshes = *geometry.meshes;
    const Words triangle = loadRecords(std::span(meshes.triangles), hits.indexOf(where, kHitTriangle));
    const Vec3 corner = gatherVec3(meshes.positions, triangle.x);
    const Vec3 toSecond = gatherVec3(meshes.positions, triangle.y) - corner;
    const Vec3 toThird = gatherVec3(meshes.positions, triangle.z) - corner;
    const CornerWeights weights(hits.ray, corner, toSecond, toThird);
    // A ray through the mean of samples may pass by the triangle, and even run parallel to it: its depth is that of the
    // plane, but no further than the corners. At the border of a narrow triangle it would be that of another place.
    const Vec3 forward = splat(geometry.frame.forward);
    const V first = dot(corner, forward);
    const V second = first + dot(toSecond, forward);
    const V third = first + dot(toThird, forward);
    const V ofPlane = dot(pointOnRay(hits.ray.origin, weights.along, hits.ray.direction), forward);
    const V depth = hn::Max(
        hn::Min(hn::Max(ofPlane, hn::Min(first, hn::Min(second, third))), hn::Max(first, hn::Max(second, third))),
        splat(0.0F));
    const Vec3 mean = gatherVec3(meshes.normals, triangle.x) * (splat(1.0F) - weights.second - weights.third) +
                      gatherVec3(meshes.normals, triangle.y) * weights.second +
                      gatherVec3(meshes.normals, triangle.z) * weights.third;
    const Vec3 flat = cross(toSecond, toThird);
    // Normals that cancel each other, as those of a sheet's two sides, are no direction.
    const Vec3 normal = normalize(select(dot(mean, mean) > splat(1.0e-12F), mean, flat));
    const M isInner = dot(flat, hits.ray.direction) > splat(0.0F);
    const V side = hn::IfThenElse(isInner, splat(-1.0F), splat(1.0F));
    const Vec3 color = meshes.colors.size() == 1 ? splat(meshes.colors.front()) : gatherVec3(meshes.colors, triangle.w);
    points.set(where, depth, normal * side, color);
}

void addGround(const ShadingGeometry& geometry, const HitRays& hits, M where, PointVector& points) {
    const V below = splat(geometry.ground.value_or(0.0F)) - hits.ray.origin.y;
    points.set(where, below / hits.ray.direction.y, splat({0.0F, 1.0F, 0.0F}), splat(geometry.groundColor));
}

void evaluateVector(const ShadingGeometry& geometry, std::size_t first, ShadingPoints& points) {
    HitRays hits;
    hits.hitId = loadInt(&points.hitId[first]);
    hits.ray = worldRay(geometry.frame, imagePointAt(geometry.frame, load(&points.x[first]), load(&points.y[first])));
    hits.inverseSquare = splat(1.0F) / dot(hits.ray.direction, hits.ray.direction);
    const Vec3 one = splat(glm::vec3(1.0F));
    PointVector found{splat(0.0F), splat(-geometry.toLight), one, one};
    const M isMetaball = floatMask(hits.hitId > splatInt(kHitMetaballs - 1));
    const M isBox = hn::AndNot(isMetaball, floatMask(hits.hitId > splatInt(kHitBox - 1)));
    const M isMesh = hn::AndNot(hn::Or(isMetaball, isBox), floatMask(hits.hitId > splatInt(kHitTriangle - 1)));
    const M isOther = hn::Or(hn::Or(isMetaball, isBox), isMesh);
    const M isSphere = hn::AndNot(isOther, floatMask(hits.hitId > splatInt(-1)));
    const M isGround = floatMask(hits.hitId == splatInt(kHitGround));
    if (!none(isGround)) addGround(geometry, hits, isGround, found);
    if (!none(isSphere)) addSpheres(geometry, hits, isSphere, found);
    if (!none(isBox)) addBoxes(geometry, hits, isBox, found);
    if (!none(isMesh)) addMeshes(geometry, hits, isMesh, found);
    if (!none(isMetaball)) addMetaballs(geometry, hits, isMetaball, found);
    store(found.depth, &points.depth[first]);
    storeVec3(pointOnRay(hits.ray.origin, found.depth, hits.ray.direction), points.position, first);
    storeVec3(found.normal, points.normal, first);
    storeVec3(found.albedo, points.albedo, first);
    if (geometry.hasSky) storeVec3(found.sky, points.sky, first);
}

void evaluateShadingPoints(const ShadingGeometry& geometry, ShadingPoints& points) {
    const std::size_t lanes = hn::Lanes(D());
    // Whole vectors of points are evaluated; the results beyond `count` are not used.
    for (std::size_t k = points.count; k % lanes != 0; ++k) points.hitId[k] = kHitBackground;
    for (std::size_t first = 0; first < points.count; first += lanes) evaluateVector(geometry, first, points);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(evaluateShadingPoints);

void evaluateShadingPoints(const ShadingGeometry& geometry, ShadingPoints& points) {
    HWY_DYNAMIC_DISPATCH(evaluateShadingPoints)(geometry, points);
}

}  // namespace render

#endif
