// Fields: what acts on particles at a distance besides gravity, everywhere or in a box, always or for some time. A
// uniform or point field accelerates particles, a flow drags them along. Part of a Setup; applied by
// stepping/take_step.h.
#pragma once

#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/core/vec3.h"

namespace engine {

/// The same acceleration everywhere.
struct UniformField {
    Vec3 acceleration = Vec3::Zero();  ///< m/s^2
};

/// Acceleration toward a center, as in the gravity of a ball of mass around it: strength * r / (r^2 + s^2)^(3/2) at the
/// distance r, where s is the softening (Plummer's potential).
struct PointField {
    Vec3 center = Vec3::Zero();  ///< m
    double strength = 1.0;       ///< acceleration times squared distance, far away, m^3/s^2; below 0 it pushes away
    double softening = 1.0;      ///< m, > 0
};

/// Drag toward the velocity of a flow: a wind, which may turn about an axis. What moves relative to the flow does so
/// less by the factor exp(-rate t).
struct FlowField {
    double rate = 1.0;             ///< 1/s
    Vec3 velocity = Vec3::Zero();  ///< of the flow at the center, m/s
    Vec3 spin = Vec3::Zero();      ///< angular velocity of the flow about the center, rad/s
    Vec3 center = Vec3::Zero();    ///< m

    Vec3 velocityAt(const Vec3& point) const { return velocity + spin.cross(point - center); }
};

struct Field {
    std::variant<UniformField, PointField, FlowField> law;
    std::optional<BoundingBox> box = {};                     ///< where it acts; everywhere if there is none
    double start = 0.0;                                      ///< it acts from this time on, s
    double until = std::numeric_limits<double>::infinity();  ///< and up to this time, s

    /// Whether particles keep the sum of their kinetic and potential energy in this field: it accelerates them
    /// everywhere and at all times.
    bool isConservative() const {
        return !std::holds_alternative<FlowField>(law) && !box && start <= 0.0 &&
               until == std::numeric_limits<double>::infinity();
    }
};

/// What a field does to velocities between two times, computed once for all particles.
class FieldKick {
 public:
    /// @param from, to  times between which the field acts for as long as it is there, s
    FieldKick(const Field& field, double from, double to);

    /// Whether the field is there at any moment between the two times.
    bool exists() const { return seconds_ > 0.0; }
    /// The velocity (m/s) after the kick of a particle that stays at a place (m) meanwhile.
    Vec3 velocityAfter(const Vec3& position, const Vec3& velocity) const;

 private:
    const Field* field_;
    double seconds_;
    double decay_ = 1.0;  ///< of the velocity relative to a flow
};

/// The strongest acceleration of a point field, at the distance 0.707 s from the center, m/s^2.
double largestAcceleration(const PointField& field);

/// Potential energy of a particle of mass 1 kg in the conservative ones of some fields, J/kg.
double fieldPotential(const std::vector<Field>& fields, const Vec3& position);

}  // namespace engine
