// The faces of obstacles as seen from a particle: a signed distance, a normal and a repulsor behind the face, so that
// one contact law serves all shapes. contact.h has the law.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/obstacles/obstacles.h"

namespace engine {

/// The surface of an obstacle for which the scene says nothing else.
inline constexpr WallSurface kPlainWall;

/// One face of an obstacle relative to one particle.
struct Surface {
    double height = 0.0;                                             ///< distance of the particle's center, signed, m
    Vec3 normal = Vec3::UnitY();                                     ///< unit vector that points away from the solid
    double repulsorRadius = 0.5;                                     ///< m
    double halfThickness = std::numeric_limits<double>::infinity();  ///< half the depth of the solid, m
    double curvature = 0.0;                                          ///< 1/radius of a sphere, otherwise 0; 1/m
    const WallSurface* wall = &kPlainWall;                           ///< how it answers under the scaled wall law
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

/// How an obstacle, given by its index, answers particles under the scaled wall law.
inline const WallSurface& wallSurfaceOf(const Obstacles& obstacles, std::size_t obstacle) {
    return obstacle < obstacles.surfaces.size() ? obstacles.surfaces[obstacle] : kPlainWall;
}

/// Calls visit(index) for all obstacles that have a surface nearer to a point than `reach` (m), and maybe for others.
/// Returns a lower bound on the distances of the obstacles that are left out, m.
template <class Visit>
double forEachNear(const Obstacles& obstacles, const Vec3& point, double reach, const Visit& visit) {
    if (obstacles.index.solids.isEmpty()) {
        for (std::size_t k = 0; k < obstacles.shapes.size(); ++k) visit(k);
        return std::numeric_limits<double>::infinity();
    }
    for (const std::uint32_t k : obstacles.index.unbounded) visit(k);
    obstacles.index.solids.visitNear(point, reach, [&](std::uint32_t box) { visit(obstacles.index.obstacleOf[box]); });
    return reach;
}

/// Calls visit(Surface) for all surfaces that are nearer to a point than `reach` (m), and maybe for others. Returns a
/// lower bound on the distances of those that are left out, m.
template <class Visit>
double forEachSurface(const Obstacles& obstacles, const Vec3& point, double reach, const Visit& visit) {
    return forEachNear(obstacles, point, reach, [&](std::size_t k) {
        const WallSurface* const wall = &wallSurfaceOf(obstacles, k);
        std::visit(
            [&](const auto& shape) {
                forEachSurface(
                    shape, point, obstacles.law.radius, [&](Surface surface) __attribute__((always_inline)) {
                        surface.wall = wall;
                        visit(surface);
                    });
            },
            obstacles.shapes[k]);
    });
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

/// Distance of a particle's center from a surface below which the surface acts on the particle, m: the particle's
/// radius, or its diameter where the surface is adhesive.
inline double contactReach(const WallSurface& wall, double radius) {
    return wall.adhesion > 0.0 ? 2.0 * radius : radius;
}

/// The largest contactReach() that any surface has for a particle of this radius (m).
constexpr double largestContactReach(double radius) {
    return 2.0 * radius;
}

/// Calls visit(Surface) for every surface that acts on a particle of this radius (m).
template <class Visit>
void forEachTouched(const Obstacles& obstacles, const Vec3& point, double radius, const Visit& visit) {
    forEachNear(obstacles, point, largestContactReach(radius), [&](std::size_t k) {
        const WallSurface& wall = wallSurfaceOf(obstacles, k);
        const double reach = contactReach(wall, radius);
        std::visit(
            [&](const auto& shape) {
                if (!mayReach(shape, point, reach)) return;
                forEachSurface(shape, point, obstacles.law.radius, [&](Surface surface) {
                    if (surface.height >= reach) return;
                    surface.wall = &wall;
                    visit(surface);
                });
            },
            obstacles.shapes[k]);
    });
}

}  // namespace engine
