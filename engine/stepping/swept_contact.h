// Swept contacts: a drift that obstacles take part in. A particle that meets an obstacle too fast or too stiffly for
// the step is followed through the meeting in as many small steps as it needs, at no cost to the others; slow contacts
// act as forces, together with those of the pairs. Used by every stepper but the paper's.
#pragma once

#include "engine/law/obstacles.h"

namespace engine {

/// A particle in flight.
struct Flight {
    Vec3 position = Vec3::Zero();  ///< m
    Vec3 velocity = Vec3::Zero();  ///< m/s
    double mass = 1.0;             ///< kg
    double radius = 0.15;          ///< m
    double dampingReach = 1.0;     ///< c_d of its material
    double friction = 0.0;         ///< mu of its material
};

/// A particle's contacts at a step's start.
struct Contacts {
    double gap = 0.0;           ///< from its surface to the nearest obstacle's, m; negative in contact
    bool needsSweep = false;    ///< they are more than the step bears
    Vec3 force = Vec3::Zero();  ///< of all of them, N; contactForce's
};

/// The contacts of the coming step (s). They are more than it bears where the particle may cover more than a fraction
/// of a contact's depth in it, or, where contacts act explicitly, comes near the limit of stability.
Contacts contactsAhead(const Obstacles& obstacles, const Flight& flight, double duration, bool isExplicit);

/// Flies on for a duration (s) under the forces of the obstacles alone, those of section 3.2.
/// Holds:  at any finite speed the center stays on the side of a plane, of a box's face and of a sphere that it came
///         from. Where the repulsor cannot stop it, it is reflected: the barrier, a departure from the paper. Under a
///         plane it lies at the law's core distance from the repulsor, in a solid a tenth of the particle's radius or
///         of half the solid's thickness under the surface. Order 2 in the duration of the stepper's step.
void fly(const Obstacles& obstacles, Flight& flight, double duration);

}  // namespace engine
