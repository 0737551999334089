// The arrival of a moving center at the surface of an obstacle: what barriers.cpp finds for each obstacle.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/obstacles/obstacle_surfaces.h"

namespace engine {

/// Distance above a surface at which centers stop, in radii. Chosen: far above rounding errors, far below any visible
/// distance.
inline constexpr double kSkin = 1e-6;

/// A center this many skins below a surface lies inside the obstacle, and is not held by it.
inline constexpr double kInside = 10.0;

/// A velocity along the normal of less than this share of the speed is rounding of a motion along the surface.
inline constexpr double kTangent = 1e-12;

inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// The arrival of a center at a surface.
struct Hit {
    double time = kNever;  ///< s from the start of the motion
    Vec3 normal = Vec3::UnitY();
    double rise = 0.0;             ///< distance along the normal that puts the center at its place above the surface, m
    std::size_t obstacle = 0;      ///< index of the obstacle
    Vec3 velocity = Vec3::Zero();  ///< of the surface's material, m/s
    bool isMoving = false;         ///< whether the surface moves
};

/// A straight motion, and what is known of it.
struct StraightMotion {
    Vec3 position, velocity;
    double speed = 0.0;
    double skin = 0.0;  ///< m
};

/// Arrival at a face of a plane at this height over it (m).
inline Hit hitOfFace(double height, const Vec3& normal, const StraightMotion& motion) {
    const double approach = -dot(motion.velocity, normal);
    if (!(approach > kTangent * motion.speed) || height < -kInside * motion.skin) return {};
    const double time = std::max(0.0, (height - motion.skin) / approach);
    return {time, normal, motion.skin - (height - time * approach)};
}

/// The arrival at an obstacle, given by its index, of which the motion or the shape allows no formula: the path is
/// followed in leaps that are no longer than the distance to the surface.
/// @param time      at which the straight motion begins, s
/// @param duration  of that motion, s
Hit hitByLeaps(const Obstacles& obstacles, std::size_t obstacle, const StraightMotion& motion, double time,
               double duration);

}  // namespace engine
