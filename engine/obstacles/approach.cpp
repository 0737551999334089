// Conservative advancement: no leap is longer than the distance to the surface over the fastest that the two can come
// together, so that none goes through. Near the surface leaps have a least length; one that ends below the surface is
// halved until it ends at the surface.
#include "engine/obstacles/approach.h"

#include <cmath>
#include <variant>

namespace engine {
namespace {

/// Least length of a leap, in radii of the particle and in thicknesses of the shape. Chosen: shorter than what a
/// particle can cut off the edge of a solid without being seen to.
constexpr double kLeastLeap = 0.02;
constexpr double kLeastOfThickness = 0.2;

/// Most halvings of a leap. Chosen: more than a double has bits.
constexpr int kMostHalvings = 60;

/// Most leaps in one motion. Chosen: far more than lead past any surface. A particle is held where they end.
constexpr int kMostLeaps = 100000;

/// How the center is to an obstacle at one moment of its motion.
struct Approach {
    double height = kNever;        ///< distance from the nearest surface, m
    Vec3 normal = Vec3::UnitY();   ///< unit normal of that surface in the scene
    Vec3 velocity = Vec3::Zero();  ///< of its material, m/s
    double speed = 0.0;            ///< at which the two come together, m/s; negative where they part
};

/// The obstacle and the straight motion among which an arrival is looked for.
struct Search {
    const Obstacles& obstacles;
    std::size_t obstacle;
    const StraightMotion& motion;
    double start;     ///< time at which the motion begins, s
    double duration;  ///< s

    Approach at(double time) const {
        Approach nearest;
        const Vec3 point = motion.position + time * motion.velocity;
        const auto visit = [&](const Surface& surface) {
            if (surface.height >= nearest.height) return;
            const Vec3 velocity = materialVelocity(surface);
            nearest = {surface.height, surface.normal, velocity, -dot(motion.velocity - velocity, surface.normal)};
        };
        constexpr double kAnyDistance = std::numeric_limits<double>::infinity();
        if (isPlaced(obstacles, obstacle))
            forEachPlacedSurface(obstacles, obstacle, point, start + time, kAnyDistance, visit);
        else
            std::visit([&](const auto& shape) { forEachSurface(shape, point, obstacles.law.radius, visit); },
                       obstacles.shapes[obstacle]);
        return nearest;
    }

    /// An upper bound on the speed at which the center and any surface of the obstacle come together, m/s.
    double fastest() const {
        if (!isPlaced(obstacles, obstacle)) return motion.speed;
        const Motion& path = obstacles.motions[obstacle];
        const Pose pose = poseOf(obstacles, obstacle, start);
        const double ofPivot = fastestBetween(path, start, start + duration, 0.0);
        const double extent =
            std::sqrt(squaredLength(motion.position - pose.position)) + (motion.speed + ofPivot) * duration;
        return motion.speed + fastestBetween(path, start, start + duration, extent);
    }

    /// Whether a surface may be within a distance (m) of the center at the start.
    bool mayReach(double distance) const {
        const Vec3 point = isPlaced(obstacles, obstacle) ? poseOf(obstacles, obstacle, start).toShape(motion.position)
                                                         : motion.position;
        return std::visit([&](const auto& shape) { return engine::mayReach(shape, point, distance); },
                          obstacles.shapes[obstacle]);
    }
};

Hit hitAt(double time, const Approach& approach, const Search& search) {
    return {time,
            approach.normal,
            search.motion.skin - approach.height,
            search.obstacle,
            approach.velocity,
            isPlaced(search.obstacles, search.obstacle)};
}

/// The arrival between a moment before it and one after it, at which the center lies below its place by more than may
/// be corrected.
Hit hitBetween(double before, double after, const Search& search) {
    Approach approach;
    double time = after;
    for (int k = 0; k < kMostHalvings; ++k) {
        time = 0.5 * (before + after);
        approach = search.at(time);
        if (std::abs(approach.height) <= search.motion.skin) break;
        (approach.height > 0.0 ? before : after) = time;
    }
    return hitAt(time, approach, search);
}

double leastLeap(const Search& search) {
    const double thickness =
        std::visit([](const auto& shape) { return thicknessOf(shape); }, search.obstacles.shapes[search.obstacle]);
    return std::min(kLeastLeap * search.motion.skin / kSkin, kLeastOfThickness * thickness);
}

}  // namespace

Hit hitByLeaps(const Obstacles& obstacles, std::size_t obstacle, const StraightMotion& motion, double time,
               double duration) {
    const Search search{obstacles, obstacle, motion, time, duration};
    const double fastest = search.fastest();
    const double skin = motion.skin;
    if (!(fastest > 0.0) || !search.mayReach(fastest * duration + 2.0 * skin)) return {};
    Approach approach = search.at(0.0);
    if (approach.height < -kInside * skin) return {};
    const double shortest = leastLeap(search) / fastest;
    double now = 0.0;
    for (int leaps = 0; leaps < kMostLeaps; ++leaps) {
        if (approach.height <= skin && approach.speed > kTangent * fastest) return hitAt(now, approach, search);
        const double next = now + std::max(shortest, (approach.height - skin) / fastest);
        const double end = std::min(next, duration);
        approach = search.at(end);
        if (approach.height < -0.5 * kInside * skin) return hitBetween(now, end, search);
        if (next >= duration && !(approach.height <= skin && approach.speed > kTangent * fastest)) return {};
        now = end;
    }
    return hitAt(now, approach, search);
}

}  // namespace engine
