// Intersections of the oracle's rays with spheres, boxes and the ground, in double precision. Header only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "studies/oracle/sky_visibility.h"

namespace oracle {

using glm::dvec3;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ray {
    dvec3 origin{0.0};
    dvec3 direction{0.0, 0.0, -1.0};  ///< direction of the ray, unit length
};

/// The point where a ray first meets a surface, and the color of the surface there.
struct Hit {
    enum class Kind : std::uint8_t { none, particle, sphereObstacle, boxObstacle, meshObstacle, ground };
    Kind kind = Kind::none;
    double distance = kInfinity;  ///< distance from the origin of the ray, m; not a depth
    dvec3 point{0.0};
    dvec3 normal{0.0};  ///< outward normal of the surface, unit length
    dvec3 albedo{0.0};
    AxisVisibility sky = kAllVisible;
    render::Medium medium{};  ///< of metaballs and meshes
    bool isInner = false;     ///< whether a mesh or metaballs are met from the inside
};

/// A vector scaled to unit length; the fallback if it is zero.
inline dvec3 unitOr(const dvec3& vector, const dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : fallback;
}

/// The part of a ray that lies inside a solid: distances from the origin of the ray, m, negative behind it.
struct Interval {
    double enter = 0.0;
    double exit = 0.0;
};

/// The foot of the perpendicular from a center onto a ray lies at the distance `along` from the ray's origin, and the
/// length of the perpendicular squared is offSquared. offSquared is computed from the perpendicular itself and not as
/// |toCenter|^2 - along^2, which would lose digits if the center is far away.
struct Foot {
    double along = 0.0;
    double offSquared = 0.0;
};

inline Foot footOf(const Ray& ray, const dvec3& center) {
    const dvec3 toCenter = center - ray.origin;
    const double along = glm::dot(toCenter, ray.direction);
    const dvec3 off = toCenter - along * ray.direction;
    return {along, glm::dot(off, off)};
}

/// The part of a ray that lies inside a sphere; nothing if the ray misses or only touches the sphere.
/// @param foot  the foot of the perpendicular from the center of the sphere
inline std::optional<Interval> sphereInterval(const Foot& foot, double radius) {
    const double halfSquared = radius * radius - foot.offSquared;
    if (halfSquared <= 0.0) return std::nullopt;
    const double half = std::sqrt(halfSquared);
    return Interval{foot.along - half, foot.along + half};
}

/// The part of a ray that lies inside a box: distances from the origin of the ray, m.
struct BoxInterval {
    double enter = -kInfinity;
    double exit = kInfinity;
    int axis = 0;  ///< axis normal to the face through which the ray enters
};

/// The part of a ray inside an axis-aligned box: after the last entry into the slab of an axis and before the first
/// exit from one. If the ray misses the box, enter > exit.
inline BoxInterval boxInterval(const Ray& ray, const dvec3& minimum, const dvec3& maximum) {
    BoxInterval interval;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = minimum[axis] - ray.origin[axis];
        const double high = maximum[axis] - ray.origin[axis];
        const double slope = ray.direction[axis];
        if (slope == 0.0) {
            if (low > 0.0 || high < 0.0) interval.enter = kInfinity;
            continue;
        }
        const double slabEnter = (slope > 0.0 ? low : high) / slope;
        if (slabEnter > interval.enter) {
            interval.enter = slabEnter;
            interval.axis = axis;
        }
        interval.exit = std::min(interval.exit, (slope > 0.0 ? high : low) / slope);
    }
    return interval;
}

/// A hit at a distance (m) along a ray, with its position but without the normal and color of the surface.
inline Hit hitAt(const Ray& ray, double distance) {
    Hit hit;
    hit.distance = distance;
    hit.point = ray.origin + distance * ray.direction;
    return hit;
}

// The three functions below find the point and the normal where a ray meets a sphere, a box or the ground. The caller
// sets the kind of the surface, its color and its sky visibility.

inline Hit hitSphere(const Ray& ray, const dvec3& center, double radius) {
    const std::optional<Interval> inside = sphereInterval(footOf(ray, center), radius);
    if (!inside || inside->exit < 0.0) return {};
    Hit hit = hitAt(ray, std::max(inside->enter, 0.0));
    hit.normal = unitOr(hit.point - center, -ray.direction);
    return hit;
}

/// The outward normal of the face of a box that is nearest to a point inside.
inline dvec3 nearestFaceNormal(const render::BoxObstacle& box, const dvec3& point) {
    const dvec3 toMinimum = point - dvec3(box.minimum);
    const dvec3 toMaximum = dvec3(box.maximum) - point;
    dvec3 normal{0.0};
    double nearest = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double distance = std::min(toMinimum[axis], toMaximum[axis]);
        if (distance >= nearest) continue;
        nearest = distance;
        normal = dvec3{0.0};
        normal[axis] = toMinimum[axis] < toMaximum[axis] ? -1.0 : 1.0;
    }
    return normal;
}

inline Hit hitBox(const Ray& ray, const render::BoxObstacle& box) {
    const BoxInterval inside = boxInterval(ray, dvec3(box.minimum), dvec3(box.maximum));
    if (inside.enter > inside.exit || inside.exit < 0.0) return {};
    Hit hit = hitAt(ray, std::max(inside.enter, 0.0));
    hit.normal[inside.axis] = ray.direction[inside.axis] > 0.0 ? -1.0 : 1.0;
    if (inside.enter < 0.0) hit.normal = nearestFaceNormal(box, ray.origin);
    return hit;
}

inline Hit hitGround(const Ray& ray, const render::Ground& ground) {
    const double distance = (double(ground.height) - ray.origin.y) / ray.direction.y;
    if (!(distance > 0.0 && std::isfinite(distance))) return {};
    Hit hit = hitAt(ray, distance);
    hit.normal = {0.0, 1.0, 0.0};
    return hit;
}

}  // namespace oracle
