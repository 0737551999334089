// How an obstacle or an emitter moves: its pose as a function of time alone, so that a resumed run and every rank see
// the same.
#pragma once

#include <limits>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Where an object is at a moment, and how it moves there.
struct Pose {
    Matrix3 rotation = Matrix3::Identity();  ///< from the shape's coordinates to those of the scene
    Vec3 pivot = Vec3::Zero();               ///< the point that it turns about, in the shape's coordinates, m
    Vec3 position = Vec3::Zero();            ///< of the pivot in the scene, m
    Vec3 velocity = Vec3::Zero();            ///< of the pivot, m/s
    Vec3 spin = Vec3::Zero();                ///< angular velocity, rad/s

    /// A point of the scene in the shape's coordinates, m.
    Vec3 toShape(const Vec3& point) const { return pivot + rotation.transpose() * (point - position); }
    /// A point of the shape in the scene, m.
    Vec3 toScene(const Vec3& point) const { return position + rotation * (point - pivot); }
    /// Velocity of the object's material at a point of the scene, m/s.
    Vec3 velocityAt(const Vec3& point) const { return velocity + spin.cross(point - position); }
};

/// A point in time of a path that an object glides along.
struct PoseKey {
    double time = 0.0;             ///< s
    Vec3 position = Vec3::Zero();  ///< of the pivot, m
    Vec3 angles = Vec3::Zero();    ///< turns about the x, then the y, then the z axis, degrees
};

/// How an object moves. Its shape is given where the pivot would be at rest and nothing was turned.
struct Motion {
    Vec3 pivot = Vec3::Zero();   ///< m
    Vec3 angles = Vec3::Zero();  ///< turns about the x, then the y, then the z axis at time zero, degrees; without keys
    Vec3 velocity = Vec3::Zero();  ///< m/s; without keys
    Vec3 spin = Vec3::Zero();      ///< angular velocity about an axis through the pivot, rad/s; without keys
    /// Path of the pivot and of the angles, in increasing order of time. Before the first and after the last key the
    /// object is at rest there. In between, all six numbers follow monotone cubics; see core/monotone_cubic.h.
    std::vector<PoseKey> keys = {};
    double until = std::numeric_limits<double>::infinity();  ///< time at which it is taken away, s

    /// Whether the shape is there for ever, where it is given.
    bool isIdentity() const { return isAtRest() && angles == Vec3::Zero(); }
    /// Whether the pose is the same at all times, although it may differ from where the shape is given.
    bool isAtRest() const {
        return velocity == Vec3::Zero() && spin == Vec3::Zero() && keys.empty() &&
               until == std::numeric_limits<double>::infinity();
    }
};

/// The pose at a time (s). Computed by additions, multiplications, divisions and square roots, which have the same bits
/// on every machine.
Pose poseAt(const Motion& motion, double time);

/// Velocity at a time (s) of the object's material at a point of the scene, m/s; as poseAt() has it, without a rotation
/// where none is needed for it.
Vec3 velocityAt(const Motion& motion, double time, const Vec3& point);

/// An upper bound on the speed of any point of an object within a distance `extent` (m) of its pivot, between two
/// times (s), m/s.
double fastestBetween(const Motion& motion, double from, double to, double extent);

}  // namespace engine
