// Poses of what moves.
#include "engine/obstacles/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/monotone_cubic.h"
#include "engine/core/rotation.h"

namespace engine {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;  // rad

/// Angular velocity (rad/s) of rotationOfDegrees() of angles that change at these rates (degrees/s).
Vec3 spinOf(const Vec3& angles, const Vec3& rates) {
    const Vec3 aboutXAndY = rates.y() * Vec3::UnitY() + rotationAboutAxis(1, angles.y()) * (rates.x() * Vec3::UnitX());
    return kDegree * (rates.z() * Vec3::UnitZ() + rotationAboutAxis(2, angles.z()) * aboutXAndY);
}

std::array<double, 6> numbersOf(const PoseKey& key) {
    return {key.position.x(), key.position.y(), key.position.z(), key.angles.x(), key.angles.y(), key.angles.z()};
}

Pose poseOnPath(const Motion& motion, double time) {
    const auto timeOf = [&](std::size_t key) { return motion.keys[key].time; };
    const auto valuesOf = [&](std::size_t key) { return numbersOf(motion.keys[key]); };
    const PathPoint<6> point = pathAt<6>(motion.keys.size(), time, timeOf, valuesOf);
    const auto& [values, slopes] = point;
    const Vec3 angles(values[3], values[4], values[5]);
    return {.rotation = rotationOfDegrees(angles),
            .pivot = motion.pivot,
            .position = {values[0], values[1], values[2]},
            .velocity = {slopes[0], slopes[1], slopes[2]},
            .spin = spinOf(angles, {slopes[3], slopes[4], slopes[5]})};
}

/// The speed of a point at a distance (m) from the pivot; nothing turns where the angular speed (rad/s) is 0.
double speedAt(double extent, double ofPivot, double angular) {
    return angular > 0.0 ? ofPivot + angular * extent : ofPivot;
}

}  // namespace

Pose poseAt(const Motion& motion, double time) {
    if (!motion.keys.empty()) return poseOnPath(motion, time);
    Pose pose{.rotation = rotationOfDegrees(motion.angles),
              .pivot = motion.pivot,
              .position = motion.pivot + time * motion.velocity,
              .velocity = motion.velocity,
              .spin = motion.spin};
    const double angular = std::sqrt(squaredLength(motion.spin));
    if (angular > 0.0) pose.rotation = rotationAbout(motion.spin / angular, angular * time) * pose.rotation;
    return pose;
}

Vec3 velocityAt(const Motion& motion, double time, const Vec3& point) {
    if (!motion.keys.empty()) return poseOnPath(motion, time).velocityAt(point);
    return motion.velocity + motion.spin.cross(point - (motion.pivot + time * motion.velocity));
}

double fastestBetween(const Motion& motion, double from, double to, double extent) {
    if (motion.keys.empty())
        return speedAt(extent, std::sqrt(squaredLength(motion.velocity)), std::sqrt(squaredLength(motion.spin)));
    double fastest = 0.0;
    for (std::size_t next = 1; next < motion.keys.size(); ++next) {
        const PoseKey& a = motion.keys[next - 1];
        const PoseKey& b = motion.keys[next];
        if (b.time <= from || a.time >= to) continue;
        // A monotone cubic is at most three times as steep as the line between its keys.
        const double steepest = 3.0 / (b.time - a.time);
        const double ofPivot = steepest * std::sqrt(squaredLength(b.position - a.position));
        const double angular = kDegree * steepest * (b.angles - a.angles).cwiseAbs().sum();
        fastest = std::max(fastest, speedAt(extent, ofPivot, angular));
    }
    return fastest;
}

}  // namespace engine
