// Where the oracle's rays (studies/oracle.cpp) meet balls, boxes and the ground, in double precision. The hits
// returned here lack their kind and albedo. Header only: the oracle is its only user.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "studies/oracle/oracle.h"

namespace oracle {

/// The vector at unit length, or the fallback for a zero vector.
inline dvec3 unitOr(const dvec3& vector, const dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : fallback;
}

/// The stretch of a ray inside a ball, in m along the ray; before the ray's origin it is negative.
struct Chord {
    double enter = 0.0;
    double exit = 0.0;
};

/// The foot of the perpendicular from the center onto the ray lies at `middle`, `offSquared` from the center. Taking
/// offSquared from the perpendicular itself, not as |toCenter|^2 - middle^2, keeps its error near one rounding of
/// |toCenter|.
struct Foot {
    double middle = 0.0;
    double offSquared = 0.0;
};

inline Foot footOf(const Ray& ray, const dvec3& center) {
    const dvec3 toCenter = center - ray.origin;
    const double middle = glm::dot(toCenter, ray.direction);
    const dvec3 off = toCenter - middle * ray.direction;
    return {middle, glm::dot(off, off)};
}

/// Nothing where the ray misses the ball or only touches it.
inline std::optional<Chord> chordOf(const Foot& foot, double radius) {
    const double halfSquared = radius * radius - foot.offSquared;
    if (halfSquared <= 0.0) return std::nullopt;
    const double half = std::sqrt(halfSquared);
    return Chord{foot.middle - half, foot.middle + half};
}

inline Hit hitSphere(const Ray& ray, const dvec3& center, double radius) {
    const std::optional<Chord> chord = chordOf(footOf(ray, center), radius);
    if (!chord || chord->exit < 0.0) return {};
    Hit hit;
    hit.distance = std::max(chord->enter, 0.0);
    hit.point = ray.origin + hit.distance * ray.direction;
    hit.normal = unitOr(hit.point - center, -ray.direction);
    return hit;
}

inline dvec3 nearestFaceNormal(const render::BoxObstacle& box, const dvec3& point) {
    const dvec3 toMinimum = point - dvec3(box.minimum);
    const dvec3 toMaximum = dvec3(box.maximum) - point;
    dvec3 normal{0.0};
    double nearest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double distance = std::min(toMinimum[axis], toMaximum[axis]);
        if (distance >= nearest) continue;
        nearest = distance;
        normal = dvec3{0.0};
        normal[axis] = toMinimum[axis] < toMaximum[axis] ? -1.0 : 1.0;
    }
    return normal;
}

/// The ray is inside the box where it is inside all three slabs: after the last entry and before the first exit.
inline Hit hitBox(const Ray& ray, const render::BoxObstacle& box) {
    double enter = -std::numeric_limits<double>::infinity();
    double exit = std::numeric_limits<double>::infinity();
    dvec3 normal{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const double low = double(box.minimum[axis]) - ray.origin[axis];
        const double high = double(box.maximum[axis]) - ray.origin[axis];
        const double slope = ray.direction[axis];
        if (slope == 0.0) {
            if (low > 0.0 || high < 0.0) return {};
            continue;
        }
        const double slabEnter = (slope > 0.0 ? low : high) / slope;
        if (slabEnter > enter) {
            enter = slabEnter;
            normal = dvec3{0.0};
            normal[axis] = slope > 0.0 ? -1.0 : 1.0;
        }
        exit = std::min(exit, (slope > 0.0 ? high : low) / slope);
    }
    if (enter > exit || exit < 0.0) return {};
    Hit hit;
    hit.distance = std::max(enter, 0.0);
    hit.point = ray.origin + hit.distance * ray.direction;
    hit.normal = enter < 0.0 ? nearestFaceNormal(box, ray.origin) : normal;
    return hit;
}

inline Hit hitGround(const Ray& ray, const render::Ground& ground) {
    const double distance = (double(ground.height) - ray.origin.y) / ray.direction.y;
    if (!(distance > 0.0 && std::isfinite(distance))) return {};
    Hit hit;
    hit.distance = distance;
    hit.point = ray.origin + distance * ray.direction;
    hit.normal = {0.0, 1.0, 0.0};
    return hit;
}

}  // namespace oracle
