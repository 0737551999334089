// The faces of obstacles as seen from a particle: a signed distance, a normal and a repulsor behind the face, so that
// one contact law serves all shapes. The law is applied as a force here and in forces/external_forces.cpp, as in
// section 3.2 of the paper, and along the path of fast particles in stepping/swept_contact.cpp.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/force_law/obstacles.h"
#include "engine/force_law/pair_law.h"

namespace engine {

/// One face of an obstacle relative to one particle.
struct Surface {
    double height = 0.0;                                             ///< distance of the particle's center, signed, m
    Vec3 normal = Vec3::UnitY();                                     ///< unit vector that points away from the solid
    double repulsorRadius = 0.5;                                     ///< m
    double halfThickness = std::numeric_limits<double>::infinity();  ///< half the depth of the solid, m
    double curvature = 0.0;                                          ///< 1/radius of a sphere, otherwise 0; 1/m
};

// The functions forEachSurface(shape, point, repulsorRadius, visit) call visit(Surface) for each face of a shape that
// can act on a particle at the point (m), at any distance.

template <class Visit>
void forEachSurface(const Plane& plane, const Vec3& point, double repulsorRadius, const Visit& visit) {
    visit(Surface{dot(point - plane.point, plane.normal), plane.normal, repulsorRadius});
}

template <class Visit>
void forEachSurface(const Container& box, const Vec3& point, double repulsorRadius, const Visit& visit) {
    for (int axis = 0; axis < 3; ++axis) {
        visit(Surface{point[axis] - box.minimum[axis], Vec3::Unit(axis), repulsorRadius});
        visit(Surface{box.maximum[axis] - point[axis], -Vec3::Unit(axis), repulsorRadius});
    }
}

/// A solid box has one surface: outside, its normal points from the closest point of the box to the particle; inside,
/// out of the nearest face.
template <class Visit>
void forEachSurface(const Box& box, const Vec3& point, double repulsorRadius, const Visit& visit) {
    const double halfThickness = 0.5 * (box.maximum - box.minimum).minCoeff();
    const Vec3 closest = point.cwiseMax(box.minimum).cwiseMin(box.maximum);
    const Vec3 away = point - closest;
    const double distance = std::sqrt(squaredLength(away));
    if (distance > 0.0) {
        visit(Surface{distance, away / distance, repulsorRadius, halfThickness});
        return;
    }
    Surface nearest{-std::numeric_limits<double>::infinity(), Vec3::UnitY(), repulsorRadius, halfThickness};
    for (int axis = 0; axis < 3; ++axis) {
        const double below = box.minimum[axis] - point[axis];
        const double above = point[axis] - box.maximum[axis];
        if (below > nearest.height) nearest = Surface{below, -Vec3::Unit(axis), repulsorRadius, halfThickness};
        if (above > nearest.height) nearest = Surface{above, Vec3::Unit(axis), repulsorRadius, halfThickness};
    }
    visit(nearest);
}

template <class Visit>
void forEachSurface(const Sphere& sphere, const Vec3& point, double repulsorRadius, const Visit& visit) {
    const Vec3 away = point - sphere.center;
    const double distance = std::sqrt(squaredLength(away));
    const Vec3 normal = distance > 0.0 ? Vec3(away / distance) : Vec3(Vec3::UnitY());
    visit(Surface{distance - sphere.radius, normal, sphere.literalRepulsor ? sphere.radius : repulsorRadius,
                  sphere.radius, 1.0 / sphere.radius});
}

/// Calls visit(Surface) for every surface of all obstacles.
template <class Visit>
void forEachSurface(const Obstacles& obstacles, const Vec3& point, const Visit& visit) {
    for (const Obstacle& obstacle : obstacles.shapes)
        std::visit([&](const auto& shape) { forEachSurface(shape, point, obstacles.law.radius, visit); }, obstacle);
}

/// Whether a shape may have a surface within a distance `reach` (m) of a point. A cheap test, without a square root or
/// a normal, that excludes the many obstacles that are far away.
template <class Shape>
bool mayReach(const Shape& shape, const Vec3& point, double reach) {
    constexpr double kSlack = 1.0 + 1e-9;  // margin of the test; chosen: far above its rounding errors
    if constexpr (std::is_same_v<Shape, Sphere>) {
        const double within = shape.radius + reach;
        return squaredLength(point - shape.center) < kSlack * within * within;
    } else if constexpr (std::is_same_v<Shape, Box>) {
        const Vec3 closest = point.cwiseMax(shape.minimum).cwiseMin(shape.maximum);
        return squaredLength(point - closest) < kSlack * reach * reach;
    } else if constexpr (std::is_same_v<Shape, Container>) {
        return ((point - shape.minimum).array() < reach).any() || ((shape.maximum - point).array() < reach).any();
    } else {
        return true;
    }
}

/// Calls visit(Surface) for every surface whose distance from a particle's center is less than its radius (m).
template <class Visit>
void forEachTouched(const Obstacles& obstacles, const Vec3& point, double radius, const Visit& visit) {
    for (const Obstacle& obstacle : obstacles.shapes)
        std::visit(
            [&](const auto& shape) {
                if (!mayReach(shape, point, radius)) return;
                forEachSurface(shape, point, obstacles.law.radius, [&](const Surface& surface) {
                    if (surface.height < radius) visit(surface);
                });
            },
            obstacle);
}

/// The contact of a particle and a surface, treated as a pair of particles: the particle and the repulsor, which lies
/// repulsorRadius behind the surface.
struct Contact {
    PairConstants<double> constants = {};
    double distance = 0.0;    ///< distance to the repulsor, at least the core distance, m
    double beyondCore = 0.0;  ///< how far the repulsor is inside the core distance, m
};

inline Contact contactWith(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    const double restLength = probe.radius + surface.repulsorRadius;
    const double core = law.coreFraction * restLength;
    const double distance = surface.height + surface.repulsorRadius;
    Contact contact;
    contact.constants = repulsorConstants(law.repulsion, law.dampingFactor * probe.dampingReach, restLength, core);
    contact.distance = std::max(distance, core);
    contact.beyondCore = contact.distance - distance;
    return contact;
}

/// Force of a contact along the surface's normal on a particle with this normal speed (m/s), in newtons. On a particle
/// closer to the repulsor than the core distance acts the force at the core distance, so that it can only be pushed out
/// on the side of the surface.
inline double normalForce(const Contact& contact, double normalSpeed) {
    return repulsorForce(contact.distance, normalSpeed, contact.constants);
}

/// Energy of the conservative part of a contact's force, in joules.
inline double contactEnergy(const Contact& contact) {
    return pairEnergy(contact.distance, contact.constants) + normalForce(contact, 0.0) * contact.beyondCore;
}

/// Energy of a particle at a surface of an obstacle, in joules; 0 where the particle does not touch the surface.
inline double surfaceEnergy(const Surface& surface, const RepulsorLaw& law, const Probe& probe) {
    return surface.height >= probe.radius ? 0.0 : contactEnergy(contactWith(surface, law, probe));
}

/// The tangential part of a velocity (m/s) at a surface with this normal.
inline Vec3 slipVelocity(const Vec3& velocity, const Vec3& normal) {
    return velocity - dot(velocity, normal) * normal;
}

/// Adds the force of a contact on the particle, in newtons, friction included. Forced inline, because a function call
/// would take half of the time.
[[gnu::always_inline]] inline void addForce(const Surface& surface, const Contact& contact, const Probe& probe,
                                            Vec3& force) {
    force += normalForce(contact, dot(probe.velocity, surface.normal)) * surface.normal;
    if (probe.friction == 0.0) return;
    const Vec3 slip = slipVelocity(probe.velocity, surface.normal);
    force -= slipDamping(probe.friction, normalForce(contact, 0.0), squaredLength(slip)) * slip;
}

/// Damping of a contact along the surface's normal, in kg/s.
inline double dampingAlong(const Contact& contact) {
    const double distanceSq = contact.distance * contact.distance;
    return pairDampingOverSq(distanceSq, contact.constants) * distanceSq;
}

/// Stiffness of a contact along the surface's normal, in N/m; 0 inside the core distance, where the force is constant.
inline double stiffnessAlong(const Contact& contact) {
    return contact.beyondCore > 0.0 ? 0.0 : std::max(0.0, pairStiffness(contact.distance, contact.constants));
}

}  // namespace engine
