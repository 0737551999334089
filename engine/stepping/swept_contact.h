// Swept contacts (continuous collision detection). A particle that meets an obstacle too fast or too stiffly for the
// step is followed through the meeting in as many small steps as it needs, at no cost to the other particles; slow
// contacts act as forces, together with those of the pairs. Used through drift.h by every stepper but the paper's.
#pragma once

#include "engine/law/obstacles.h"

namespace engine {

/// A particle that only obstacles act on for a while.
struct BallisticState {
    Probe probe;        ///< the particle as obstacles see it
    double mass = 1.0;  ///< kg
};

/// A particle's contacts at the start of a step.
struct Contacts {
    double gap = 0.0;           ///< distance from its surface to the nearest obstacle's, m; negative in contact
    bool needsSweep = false;    ///< whether the step is too long for them to act as forces
    Vec3 force = Vec3::Zero();  ///< sum over the contacts as sumContacts() has it, N
};

/// The contacts of a step of this duration (s). They need a sweep where the particle may cover more than a fraction of
/// a contact's depth in the step, or, where contacts act explicitly, comes near the limit of stability.
Contacts contactsInStep(const Obstacles& obstacles, const BallisticState& state, double duration, bool isExplicit);

/// Moves the particle for a duration (s) under the forces of the obstacles alone, those of section 3.2 of the paper.
/// At any finite speed its center stays on the side of a plane, of a box's face and of a sphere that it came from.
/// Where the repulsor cannot stop it, it is reflected at a barrier, which is a departure from the paper: under a plane
/// the barrier lies at the law's core distance from the repulsor, in a solid a tenth of the particle's radius or of
/// half the solid's thickness under the surface. The error is of second order in the duration.
void advanceThroughContacts(const Obstacles& obstacles, BallisticState& state, double duration);

}  // namespace engine
