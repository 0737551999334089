// Poses of obstacles in motion.
#include "engine/obstacles/motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/monotone_cubic.h"
#include "engine/core/sine.h"

namespace engine {
namespace {

/// A turn about one of the axes of the scene by an angle (rad).
Matrix3 turnAboutAxis(int axis, double angle) {
    const auto [sine, cosine] = sineAndCosine(angle);
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    Matrix3 turn = Matrix3::Identity();
    turn(next, next) = cosine;
    turn(next, last) = -sine;
    turn(last, next) = sine;
    turn(last, last) = cosine;
    return turn;
}

/// A turn about an axis, a unit vector, by an angle (rad).
Matrix3 turnAbout(const Vec3& axis, double angle) {
    const auto [sine, cosine] = sineAndCosine(angle);
    Matrix3 cross;
    cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
    return cosine * Matrix3::Identity() + sine * cross + (1.0 - cosine) * (axis * axis.transpose());
}

/// The turn by three angles, about x first.
Matrix3 turnBy(const Vec3& angles) {
    return turnAboutAxis(2, angles.z()) * turnAboutAxis(1, angles.y()) * turnAboutAxis(0, angles.x());
}

/// Angular velocity (rad/s) of turnBy() of angles that change at these rates (rad/s).
Vec3 spinOf(const Vec3& angles, const Vec3& rates) {
    const Matrix3 aboutZ = turnAboutAxis(2, angles.z());
    const Matrix3 aboutY = turnAboutAxis(1, angles.y());
    return rates.z() * Vec3::UnitZ() + aboutZ * (rates.y() * Vec3::UnitY() + aboutY * (rates.x() * Vec3::UnitX()));
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
    return {.rotation = turnBy(angles),
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
    Pose pose{.rotation = turnBy(motion.angles),
              .pivot = motion.pivot,
              .position = motion.pivot + time * motion.velocity,
              .velocity = motion.velocity,
              .spin = motion.spin};
    const double angular = std::sqrt(squaredLength(motion.spin));
    if (angular > 0.0) pose.rotation = turnAbout(motion.spin / angular, angular * time) * pose.rotation;
    return pose;
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
        const double angular = steepest * (b.angles - a.angles).cwiseAbs().sum();
        fastest = std::max(fastest, speedAt(extent, ofPivot, angular));
    }
    return fastest;
}

}  // namespace engine
