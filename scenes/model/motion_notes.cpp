// The speed of a solid's surface is that of the fastest corner of the box around it, which is exact for boxes.
#include "scenes/model/motion_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/model/field_text.h"

namespace scenes {
namespace {

using engine::Motion;
using engine::Vec3;

/// Number of moments in a turn, or between two keys, at which speeds are looked at. Chosen: the fastest of a turn is
/// then met to a thousandth, for 1 - cos(pi / 64) is 0.0012.
constexpr int kMoments = 64;

/// The corners of a box.
std::vector<Vec3> cornersOf(const engine::BoundingBox& box) {
    std::vector<Vec3> corners;
    for (int corner = 0; corner < 8; ++corner) {
        const auto chosen = [&](int axis) { return (corner >> axis & 1) != 0 ? box.high[axis] : box.low[axis]; };
        corners.emplace_back(chosen(0), chosen(1), chosen(2));
    }
    return corners;
}

/// Moments among which the fastest of a motion is, s.
std::vector<double> momentsOf(const Motion& motion) {
    std::vector<double> moments = {0.0};
    const auto addBetween = [&](double from, double to) {
        const double end = std::min(to, motion.until);
        if (from > end) return;
        for (int k = 0; k <= kMoments; ++k) moments.push_back(from + (end - from) * k / kMoments);
    };
    for (std::size_t key = 1; key < motion.keys.size(); ++key)
        addBetween(motion.keys[key - 1].time, motion.keys[key].time);
    if (const double angular = motion.spin.norm(); angular > 0.0) addBetween(0.0, 2.0 * std::numbers::pi / angular);
    return moments;
}

/// The speed of the fastest of some points of an object at any time, m/s.
double fastestOf(const Motion& motion, const std::vector<Vec3>& points) {
    double fastest = 0.0;
    for (const double moment : momentsOf(motion)) {
        const engine::Pose pose = engine::poseAt(motion, moment);
        for (const Vec3& point : points) fastest = std::max(fastest, pose.velocityAt(pose.toScene(point)).norm());
    }
    return fastest;
}

bool isTurning(const Motion& motion) {
    const auto isTurned = [&](const engine::PoseKey& key) { return key.angles != motion.keys.front().angles; };
    return motion.spin != Vec3::Zero() || std::ranges::any_of(motion.keys, isTurned);
}

/// "+y" for a direction along an axis, else its unit vector.
std::string directionText(const Vec3& vector) {
    const Vec3 direction = vector.normalized();
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(vector[axis]) == vector.cwiseAbs().sum())
            return fmt::format("{}{}", vector[axis] < 0.0 ? '-' : '+', "xyz"[axis]);
    return vectorText(direction);
}

std::string keysText(const Motion& motion) {
    const engine::PoseKey& first = motion.keys.front();
    if (motion.keys.size() == 1) return "stays where its one key puts it";
    double farthest = 0.0;
    double turned = 0.0;
    for (const double moment : momentsOf(motion))
        farthest = std::max(farthest, (engine::poseAt(motion, moment).position - first.position).norm());
    for (const engine::PoseKey& key : motion.keys)
        turned = std::max(turned, (key.angles - first.angles).cwiseAbs().maxCoeff());
    std::string text =
        fmt::format("follows {} keys from {:.4g} to {:.4g} s", motion.keys.size(), first.time, motion.keys.back().time);
    if (farthest > 0.0) text += fmt::format(", farthest {:.3g} m", farthest);
    if (turned > 0.0) text += fmt::format(", turned by up to {:.4g} degrees", turned);
    return text;
}

std::string steadyText(const Motion& motion) {
    const bool isMoving = motion.velocity != Vec3::Zero();
    std::string text;
    if (isMoving)
        text = fmt::format("moves at {:.3g} m/s along {}", motion.velocity.norm(), directionText(motion.velocity));
    if (motion.spin == Vec3::Zero()) return text;
    const std::string turns = fmt::format("{:.3g} times", motion.spin.norm() / (2.0 * std::numbers::pi));
    return fmt::format("{}{}turns {} a second about the axis {} through {}{}", text, isMoving ? " and " : "",
                       turns == "1 times" ? "once" : turns, vectorText(motion.spin.normalized()),
                       vectorText(motion.pivot), isMoving ? " at the start" : "");
}

std::string pathText(const Motion& motion) {
    const std::string text = motion.keys.empty() ? steadyText(motion) : keysText(motion);
    if (!std::isfinite(motion.until)) return text;
    if (text.empty()) return fmt::format("is taken away at {:.4g} s", motion.until);
    return fmt::format("{} until {:.4g} s, then is taken away", text, motion.until);
}

/// What is said of the speed of a note whose numbers are complete; empty if that is clear without.
/// @param place  of which the speed is, "surface" or "nozzle"
std::string speedText(const Motion& motion, const MotionNote& note, const char* place) {
    std::string text;
    const bool isSaid = motion.keys.empty() && !isTurning(motion);
    if (!isSaid && note.fastest.value_or(0.0) > 0.0)
        text = fmt::format("; up to {:.3g} m/s at its {}", *note.fastest, place);
    if (note.radiiPerFrame.value_or(0.0) > 1.0)
        text += fmt::format("{} {:.3g} particle radii a frame", text.empty() ? ";" : ",", *note.radiiPerFrame);
    return text;
}

/// The radius of the smallest particles that a scene has or may emit, m.
double smallestRadius(const Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const double radius : scene.setup.initial.radius) smallest = std::min(smallest, radius);
    for (const engine::Emitter& emitter : scene.setup.emitters)
        smallest = std::min(smallest, scene.setup.materials[emitter.material].radius);
    return smallest;
}

MotionNote obstacleNote(const Scene& scene, std::size_t k) {
    const Motion& motion = scene.setup.obstacles.motions[k];
    MotionNote note{"obstacle", k + 1, scene.obstacleShapes[k], pathText(motion), {}, {}};
    const auto bounds = engine::boundsOf(scene.setup.obstacles.shapes[k]);
    if (bounds || !isTurning(motion))
        note.fastest = fastestOf(motion, bounds ? cornersOf(*bounds) : std::vector{motion.pivot});
    if (note.fastest) note.radiiPerFrame = *note.fastest * scene.fps.timeOf(1) / smallestRadius(scene);
    note.text += speedText(motion, note, "surface");
    return note;
}

MotionNote emitterNote(const Scene& scene, std::size_t e) {
    const engine::Emitter& emitter = scene.setup.emitters[e];
    MotionNote note{"emitter", e + 1, {}, pathText(emitter.motion), {}, {}};
    note.fastest = fastestOf(emitter.motion, emitter.sites);
    note.text += speedText(emitter.motion, note, "nozzle");
    return note;
}

}  // namespace

std::vector<MotionNote> motionNotes(const Scene& scene) {
    std::vector<MotionNote> notes;
    const std::vector<Motion>& motions = scene.setup.obstacles.motions;
    for (std::size_t k = 0; k < motions.size(); ++k)
        if (!motions[k].isAtRest()) notes.push_back(obstacleNote(scene, k));
    for (std::size_t e = 0; e < scene.setup.emitters.size(); ++e)
        if (!scene.setup.emitters[e].motion.isAtRest()) notes.push_back(emitterNote(scene, e));
    return notes;
}

}  // namespace scenes
