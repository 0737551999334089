// Finds the first surface on the way, moves the center there, changes the velocity, and goes on from there. A center
// stops at a small distance above a surface, so that rounding never puts it on the other side and a particle that
// slides over the seam between two boxes meets neither of them.
#include "engine/obstacles/barriers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/obstacles/obstacle_surfaces.h"

namespace engine {
namespace {

/// Distance above a surface at which centers stop, in radii. Chosen: far above rounding errors, far below any visible
/// distance.
constexpr double kSkin = 1e-6;

/// A center this many skins below a surface lies inside the obstacle, and is not held by it.
constexpr double kInside = 10.0;

/// A velocity along the normal of less than this share of the speed is rounding of a motion along the surface.
constexpr double kTangent = 1e-12;

/// Most surfaces that a particle meets in one motion. Chosen: more than meet in any corner. In a gap that narrows,
/// where it goes from side to side, the particle then stays where it is until the next motion.
constexpr int kMostHits = 16;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The arrival of a center at a surface.
struct Hit {
    double time = kNever;  ///< s
    Vec3 normal = Vec3::UnitY();
    double rise = 0.0;  ///< distance along the normal that puts the center at its place above the surface, m
    const WallSurface* wall = nullptr;
};

/// A straight motion, and what is known of it.
struct Motion {
    Vec3 position, velocity;
    double speed = 0.0;
    double skin = 0.0;  ///< m
};

/// Arrival at a face of a plane at this height over it (m).
Hit hitOfFace(double height, const Vec3& normal, const Motion& motion) {
    const double approach = -dot(motion.velocity, normal);
    if (!(approach > kTangent * motion.speed) || height < -kInside * motion.skin) return {};
    const double time = std::max(0.0, (height - motion.skin) / approach);
    return {time, normal, motion.skin - (height - time * approach)};
}

Hit earlier(const Hit& a, const Hit& b) {
    return b.time < a.time ? b : a;
}

Hit hitOf(const Plane& plane, const Motion& motion) {
    return hitOfFace(dot(motion.position - plane.point, plane.normal), plane.normal, motion);
}

Hit hitOf(const Container& box, const Motion& motion) {
    Hit first;
    for (int axis = 0; axis < 3; ++axis) {
        first = earlier(first, hitOfFace(motion.position[axis] - box.minimum[axis], Vec3::Unit(axis), motion));
        first = earlier(first, hitOfFace(box.maximum[axis] - motion.position[axis], -Vec3::Unit(axis), motion));
    }
    return first;
}

/// Arrival of a center that lies less than a skin away from a box, at the face that it is furthest outside of.
Hit hitFromSkin(const Box& box, const Motion& motion) {
    double height = -kNever;
    Vec3 normal = Vec3::UnitY();
    for (int axis = 0; axis < 3; ++axis) {
        const double below = box.minimum[axis] - motion.position[axis];
        const double above = motion.position[axis] - box.maximum[axis];
        if (std::max(below, above) <= height) continue;
        height = std::max(below, above);
        normal = below > above ? Vec3(-Vec3::Unit(axis)) : Vec3::Unit(axis);
    }
    return hitOfFace(height, normal, motion);
}

/// The box, larger by the skin, is the intersection of three slabs: a center arrives at it when it has entered all.
Hit hitOf(const Box& box, const Motion& motion) {
    Hit last{-kNever};
    double leaves = kNever;
    for (int axis = 0; axis < 3; ++axis) {
        const double speed = std::abs(motion.velocity[axis]);
        const double below = box.minimum[axis] - motion.skin - motion.position[axis];
        const double above = motion.position[axis] - box.maximum[axis] - motion.skin;
        if (speed <= kTangent * motion.speed) {
            if (std::max(below, above) >= 0.0) return {};
            continue;
        }
        const bool isForwards = motion.velocity[axis] > 0.0;
        const double enters = (isForwards ? below : above) / speed;
        leaves = std::min(leaves, (isForwards ? -above : -below) / speed);
        if (enters > last.time) last = {enters, (isForwards ? -1.0 : 1.0) * Vec3::Unit(axis)};
    }
    if (last.time >= leaves || leaves <= 0.0) return {};
    return last.time >= 0.0 ? last : hitFromSkin(box, motion);
}

Hit hitOf(const Sphere& sphere, const Motion& motion) {
    const Vec3 away = motion.position - sphere.center;
    const double distance = std::sqrt(squaredLength(away));
    const double height = distance - sphere.radius;
    if (distance == 0.0 || height < -kInside * motion.skin) return {};
    if (height <= motion.skin) return hitOfFace(height, away / distance, motion);
    // |away + t v| = radius + skin
    const double reach = sphere.radius + motion.skin;
    const double approach = -dot(away, motion.velocity);
    if (!(approach > 0.0)) return {};
    const double speedSq = squaredLength(motion.velocity);
    const double outside = (distance - reach) * (distance + reach);
    const double discriminant = approach * approach - speedSq * outside;
    if (!(discriminant > 0.0)) return {};
    const double time = outside / (approach + std::sqrt(discriminant));
    const Vec3 there = away + time * motion.velocity;
    const double length = std::sqrt(squaredLength(there));
    return {time, there / length, reach - length};
}

Hit firstHit(const Obstacles& obstacles, const Motion& motion, double duration) {
    Hit first;
    const double reach = motion.speed * duration + 2.0 * motion.skin;
    forEachNear(obstacles, motion.position, reach, [&](std::size_t k) {
        const Hit hit = std::visit(
            [&](const auto& shape) { return mayReach(shape, motion.position, reach) ? hitOf(shape, motion) : Hit{}; },
            obstacles.shapes[k]);
        if (hit.time >= first.time) return;
        first = hit;
        first.wall = &wallSurfaceOf(obstacles, k);
    });
    return first;
}

/// Changes the velocity of a particle that arrives at a surface.
void respond(const Hit& hit, Arrival arrival, Probe& particle) {
    const double restitution = arrival == Arrival::rebounds ? hit.wall->rebound.restitution : 0.0;
    const double approach = -dot(particle.velocity, hit.normal);
    const double change = (1.0 + restitution) * approach;
    Vec3 slip = particle.velocity + approach * hit.normal;
    const double slipSpeed = std::sqrt(squaredLength(slip));
    const double friction = hit.wall->friction.value_or(particle.friction);
    if (slipSpeed > 0.0) slip *= std::max(0.0, 1.0 - friction * change / slipSpeed);
    particle.velocity = slip + (change - approach) * hit.normal;
}

}  // namespace

int moveAmongBarriers(const Obstacles& obstacles, Probe& particle, double duration, Arrival arrival) {
    Motion motion{particle.position, particle.velocity, 0.0, kSkin * particle.radius};
    double remaining = duration;
    for (int hits = 0; hits < kMostHits; ++hits) {
        motion.speed = std::sqrt(squaredLength(particle.velocity));
        motion.position = particle.position;
        motion.velocity = particle.velocity;
        const Hit hit = firstHit(obstacles, motion, remaining);
        // Written so that a NaN ends the motion; the check after the step reports it.
        if (!(hit.time <= remaining)) {
            particle.position += remaining * particle.velocity;
            return hits;
        }
        particle.position += hit.time * particle.velocity + hit.rise * hit.normal;
        respond(hit, arrival, particle);
        remaining -= hit.time;
    }
    return kMostHits;
}

}  // namespace engine
