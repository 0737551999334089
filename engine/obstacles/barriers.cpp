// Finds the first surface on the way, moves the center there, changes the velocity, and goes on from there. A center
// stops at a small distance above a surface, so that rounding never puts it on the other side and a particle that
// slides over the seam between two boxes meets neither of them. Surfaces in motion, and shapes without a formula, are
// in approach.cpp.
#include "engine/obstacles/barriers.h"

#include <algorithm>
#include <cmath>

#include "engine/obstacles/approach.h"
#include "engine/obstacles/obstacle_surfaces.h"

namespace engine {
namespace {

/// Most surfaces that a particle meets in one motion. Chosen: more than meet in any corner. In a gap that narrows,
/// where it goes from side to side, the particle then stays where it is until the next motion.
constexpr int kMostHits = 16;

Hit earlier(const Hit& a, const Hit& b) {
    return b.time < a.time ? b : a;
}

Hit hitOf(const Plane& plane, const StraightMotion& motion) {
    return hitOfFace(dot(motion.position - plane.point, plane.normal), plane.normal, motion);
}

Hit hitOf(const Container& box, const StraightMotion& motion) {
    Hit first;
    for (int axis = 0; axis < 3; ++axis) {
        first = earlier(first, hitOfFace(motion.position[axis] - box.minimum[axis], Vec3::Unit(axis), motion));
        first = earlier(first, hitOfFace(box.maximum[axis] - motion.position[axis], -Vec3::Unit(axis), motion));
    }
    return first;
}

/// Arrival of a center that lies less than a skin away from a box, at the face that it is furthest outside of.
Hit hitFromSkin(const Box& box, const StraightMotion& motion) {
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
Hit hitOf(const Box& box, const StraightMotion& motion) {
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

Hit hitOf(const Sphere& sphere, const StraightMotion& motion) {
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

Hit firstHit(const Obstacles& obstacles, const StraightMotion& motion, double time, double duration) {
    Hit first;
    const double reach = motion.speed * duration + 2.0 * motion.skin;
    forEachNear(obstacles, motion.position, time, reach, [&](std::size_t k) {
        const auto byLeaps = [&] { return hitByLeaps(obstacles, k, motion, time, std::min(duration, first.time)); };
        const auto hitOfShape = [&](const auto& shape) {
            if (!mayReach(shape, motion.position, reach)) return Hit{};
            if constexpr (isKnownByDistance<std::decay_t<decltype(shape)>>)
                return byLeaps();
            else
                return hitOf(shape, motion);
        };
        const Hit hit = isPlaced(obstacles, k) ? byLeaps() : std::visit(hitOfShape, obstacles.shapes[k]);
        if (hit.time >= first.time) return;
        first = hit;
        first.obstacle = k;
    });
    return first;
}

/// Changes the velocity of a particle that arrives at a surface.
void respond(const Hit& hit, const WallSurface& wall, Arrival arrival, Probe& particle) {
    const double restitution = arrival == Arrival::rebounds ? wall.rebound.restitution : 0.0;
    const Vec3 velocity = particle.velocity - hit.velocity;
    const double approach = -dot(velocity, hit.normal);
    const double change = (1.0 + restitution) * approach;
    Vec3 slip = velocity + approach * hit.normal;
    const double slipSpeed = std::sqrt(squaredLength(slip));
    const double friction = wall.friction.value_or(particle.friction);
    if (slipSpeed > 0.0) slip *= std::max(0.0, 1.0 - friction * change / slipSpeed);
    particle.velocity = slip + (change - approach) * hit.normal;
    if (hit.isMoving) particle.velocity += hit.velocity;
}

/// Where the point of an obstacle in motion that is at a point (m) now is at a later time (s), m.
Vec3 carried(const Obstacles& obstacles, std::size_t obstacle, const Vec3& point, double now, double later) {
    return poseOf(obstacles, obstacle, later).toScene(poseOf(obstacles, obstacle, now).toShape(point));
}

/// The mean velocity of the surface of a hit until a later time (s), m/s. A particle that moves with it is still on the
/// surface then, although the surface may turn or accelerate on the way.
Vec3 meanVelocity(const Obstacles& obstacles, const Hit& hit, const Vec3& point, double now, double later) {
    // Over a shorter time the mean would be of rounding errors.
    constexpr double kShortest = 1e-9;  // s
    if (later - now < kShortest) return hit.velocity;
    return (carried(obstacles, hit.obstacle, point, now, later) - point) / (later - now);
}

}  // namespace

int moveAmongBarriers(const Obstacles& obstacles, Probe& particle, double duration, Arrival arrival,
                      ContactLoads* loads) {
    StraightMotion motion{particle.position, particle.velocity, 0.0, kSkin * particle.radius};
    const double end = particle.time + duration;
    double remaining = duration;
    Hit hit;
    for (int hits = 0; hits < kMostHits; ++hits) {
        motion.speed = std::sqrt(squaredLength(particle.velocity));
        motion.position = particle.position;
        motion.velocity = particle.velocity;
        hit = firstHit(obstacles, motion, end - remaining, remaining);
        // Written so that a NaN ends the motion; the check after the step reports it.
        if (!(hit.time <= remaining)) {
            particle.position += remaining * particle.velocity;
            particle.time = end;
            return hits;
        }
        particle.position += hit.time * particle.velocity + hit.rise * hit.normal;
        remaining -= hit.time;
        if (hit.isMoving) hit.velocity = meanVelocity(obstacles, hit, particle.position, end - remaining, end);
        respond(hit, wallSurfaceOf(obstacles, hit.obstacle), arrival, particle);
        if (loads != nullptr && isRecorded(obstacles, hit.obstacle))
            loads->push_back({hit.obstacle, particle.mass * (particle.velocity - motion.velocity), particle.position,
                              hit.velocity, end - remaining});
    }
    // In a narrow gap: what moves takes the particle along.
    if (hit.isMoving) particle.position = carried(obstacles, hit.obstacle, particle.position, end - remaining, end);
    particle.time = end;
    return kMostHits;
}

}  // namespace engine
