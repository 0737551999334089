// The faces of obstacles as seen from a particle: a signed distance, a normal, a velocity and a repulsor behind the
// face, so that one contact law serves all shapes. contact.h has the law.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/obstacles/obstacles.h"

namespace engine {

/// The surface of an obstacle for which the scene says nothing else.
inline constexpr WallSurface kPlainWall;

/// How the material of an obstacle moves near a particle. Along the normal of a face both velocities are the same.
struct SurfaceMotion {
    /// Where the particle's center is, m/s. Damping and friction follow from it: a particle that an obstacle carries
    /// along as it turns is at rest relative to it.
    Vec3 velocity = Vec3::Zero();
    /// At the face, m/s: no faster than fastestSurface() says.
    Vec3 faceVelocity = Vec3::Zero();
};

/// One face of an obstacle relative to one particle.
struct Surface {
    double height = 0.0;                                             ///< distance of the particle's center, signed, m
    Vec3 normal = Vec3::UnitY();                                     ///< unit vector that points away from the solid
    double repulsorRadius = 0.5;                                     ///< m
    double halfThickness = std::numeric_limits<double>::infinity();  ///< half the depth of the solid, m
    double curvature = 0.0;                                          ///< 1/radius of a sphere, otherwise 0; 1/m
    const WallSurface* wall = &kPlainWall;                           ///< how it answers under the scaled wall law
    double slope = 1.0;                                              ///< change of the height along the normal
    const SurfaceMotion* motion = nullptr;                           ///< null for an obstacle at rest, which most are
    std::size_t obstacle = 0;                                        ///< index of the obstacle that it belongs to
};

/// Velocity of the obstacle's material where the particle's center is, m/s.
inline Vec3 materialVelocity(const Surface& surface) {
    return surface.motion == nullptr ? Vec3(Vec3::Zero()) : surface.motion->velocity;
}

// The functions forEachSurface(shape, point, repulsorRadius, visit) call visit(Surface) for each face of a shape that
// can act on a particle at the point (m, in the shape's coordinates), at any distance.

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

/// Where a grid has no gradient, far from the surface, the slope is zero.
template <class Distances, class Visit>
void forEachSurface(const DistanceSolid<Distances>& solid, const Vec3& point, double repulsorRadius,
                    const Visit& visit) {
    const SignedDistance distance = solid.at(point);
    Surface surface{distance.value, Vec3::UnitY(), repulsorRadius, 0.5 * solid.thickness};
    surface.slope = std::sqrt(squaredLength(distance.gradient));
    if (surface.slope > 0.0) surface.normal = distance.gradient / surface.slope;
    visit(surface);
}

/// Whether a shape is known by its signed distance alone: no formula tells where a straight path arrives at it.
template <class Shape>
inline constexpr bool isKnownByDistance = false;
template <class Distances>
inline constexpr bool isKnownByDistance<DistanceSolid<Distances>> = true;

/// The thickness of a shape at its thinnest place, m; infinite where it has no far side.
inline double thicknessOf(const Box& box) {
    return (box.maximum - box.minimum).minCoeff();
}

inline double thicknessOf(const Sphere& sphere) {
    return 2.0 * sphere.radius;
}

template <class Distances>
double thicknessOf(const DistanceSolid<Distances>& solid) {
    return solid.thickness;
}

inline double thicknessOf(const Plane& /*plane*/) {
    return std::numeric_limits<double>::infinity();
}

inline double thicknessOf(const Container& /*walls*/) {
    return std::numeric_limits<double>::infinity();
}

/// How an obstacle, given by its index, answers particles under the scaled wall law.
inline const WallSurface& wallSurfaceOf(const Obstacles& obstacles, std::size_t obstacle) {
    return obstacle < obstacles.surfaces.size() ? obstacles.surfaces[obstacle] : kPlainWall;
}

/// Whether a shape may have a surface within a distance `reach` (m) of a point. A cheap test, without a square root or
/// a normal, that excludes the many obstacles that are far away.
template <class Shape>
bool mayReach(const Shape& shape, const Vec3& point, double reach) {
    if constexpr (std::is_same_v<Shape, Sphere>) {
        constexpr double kSlack = 1.0 + 1e-9;  // as in BoundingBox::isNear()
        const double within = shape.radius + reach;
        return squaredLength(point - shape.center) < kSlack * within * within;
    } else if constexpr (std::is_same_v<Shape, Box>) {
        return BoundingBox{shape.minimum, shape.maximum}.isNear(point, reach);
    } else if constexpr (std::is_same_v<Shape, Container>) {
        return ((point - shape.minimum).array() < reach).any() || ((shape.maximum - point).array() < reach).any();
    } else if constexpr (isKnownByDistance<Shape>) {
        return shape.bounds.isNear(point, reach);
    } else {
        return true;
    }
}

/// Calls visit(index) for all obstacles that have a surface nearer to a point than `reach` (m) at a time (s), or, if
/// the time is in a step whose places are kept, at any time of that step; maybe for others, too. Returns a lower bound
/// on the distances of the obstacles that are left out, m.
template <class Visit>
double forEachNear(const Obstacles& obstacles, const Vec3& point, double time, double reach, const Visit& visit) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool areBounded = !obstacles.kept.swept.empty() && obstacles.kept.include(time);
    bool isOneAway = false;
    const auto visitUnlessAway = [&](std::size_t k) __attribute__((always_inline)) {
        const bool isAway = areBounded && !obstacles.kept.swept[k].isNear(point, reach);
        isOneAway |= isAway;
        if (!isAway) visit(k);
    };
    if (obstacles.index.solids.isEmpty()) {
        for (std::size_t k = 0; k < obstacles.shapes.size(); ++k) visitUnlessAway(k);
        return isOneAway ? reach : kInfinity;
    }
    for (const std::uint32_t k : obstacles.index.unbounded) visitUnlessAway(k);
    obstacles.index.solids.visitNear(point, reach, [&](std::uint32_t box) { visit(obstacles.index.obstacleOf[box]); });
    return reach;
}

/// Calls visit(Surface) for the surfaces of an obstacle, given by its index, that is turned or moves, if at a time (s)
/// it may have one within a distance `reach` (m) of a point.
template <class Visit>
[[gnu::noinline]] void forEachPlacedSurface(const Obstacles& obstacles, std::size_t obstacle, const Vec3& point,
                                            double time, double reach, const Visit& visit) {
    if (time >= obstacles.motions[obstacle].until) return;
    const Pose pose = poseOf(obstacles, obstacle, time);
    const Vec3 inShape = pose.toShape(point);
    std::visit(
        [&](const auto& shape) {
            if (!mayReach(shape, inShape, reach)) return;
            forEachSurface(shape, inShape, obstacles.law.radius, [&](Surface surface) {
                surface.normal = pose.rotation * surface.normal;
                const Vec3 foot = point - surface.height * surface.normal;
                const SurfaceMotion motion{pose.velocityAt(point), pose.velocityAt(foot)};
                surface.motion = &motion;
                visit(surface);
            });
        },
        obstacles.shapes[obstacle]);
}

/// Calls visit(Surface) for all surfaces that are nearer to a point than `reach` (m) at a time (s), and maybe for
/// others. Returns a lower bound on the distances of those that are left out, m.
template <class Visit>
double forEachSurface(const Obstacles& obstacles, const Vec3& point, double time, double reach, const Visit& visit) {
    return forEachNear(obstacles, point, time, reach, [&](std::size_t k) {
        const WallSurface* const wall = &wallSurfaceOf(obstacles, k);
        const auto visitHere = [&](Surface surface) __attribute__((always_inline)) {
            surface.wall = wall;
            surface.obstacle = k;
            visit(surface);
        };
        if (isPlaced(obstacles, k)) {
            constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
            forEachPlacedSurface(obstacles, k, point, time, kAnyDistance, visitHere);
            return;
        }
        std::visit([&](const auto& shape) { forEachSurface(shape, point, obstacles.law.radius, visitHere); },
                   obstacles.shapes[k]);
    });
}

/// Distance from a surface at which its pull on a liquid ends, in radii of a particle: two diameters above a particle
/// at rest on it. Chosen: as many layers as the pull between particles reaches. With less, drops do not spread.
inline constexpr double kWettingReach = 5.0;

/// Distance of a particle's center from a surface below which the surface acts on the particle, m: the particle's
/// radius, its diameter where the surface is adhesive, or kWettingReach where it pulls on liquids.
inline double contactReach(const WallSurface& wall, double radius) {
    if (wall.wetting > 0.0) return kWettingReach * radius;
    return wall.adhesion > 0.0 ? 2.0 * radius : radius;
}

/// The largest contactReach() of a particle of this radius (m), where some surface pulls on liquids or where none does.
constexpr double largestContactReach(bool isWetted, double radius) {
    return (isWetted ? kWettingReach : 2.0) * radius;
}

/// Calls visit(Surface) for every surface that acts at a time (s) on a particle of this radius (m).
template <class Visit>
void forEachTouched(const Obstacles& obstacles, const Vec3& point, double time, double radius, const Visit& visit) {
    forEachNear(obstacles, point, time, largestContactReach(obstacles.index.isWetted, radius), [&](std::size_t k) {
        const WallSurface& wall = wallSurfaceOf(obstacles, k);
        const double reach = contactReach(wall, radius);
        const auto visitTouched = [&](Surface surface) {
            if (surface.height >= reach) return;
            surface.wall = &wall;
            surface.obstacle = k;
            visit(surface);
        };
        if (isPlaced(obstacles, k)) return forEachPlacedSurface(obstacles, k, point, time, reach, visitTouched);
        std::visit(
            [&](const auto& shape) {
                if (mayReach(shape, point, reach)) forEachSurface(shape, point, obstacles.law.radius, visitTouched);
            },
            obstacles.shapes[k]);
    });
}

}  // namespace engine
