// Swept contacts (continuous collision detection). A particle that meets an obstacle too fast or too stiffly for the
// step is followed through the meeting in as many small steps as it needs, at no cost to the other particles; slow
// contacts act as forces, together with those of the pairs. Used through drift.h by every stepper but the paper's.
#pragma once

#include "engine/obstacles/contact_loads.h"
#include "engine/obstacles/obstacles.h"

namespace engine {

/// The contacts of a particle with obstacles at the start of a step.
struct Contacts {
    double gap = 0.0;           ///< distance from the particle to the nearest obstacle, m; negative in contact
    bool mayTouch = false;      ///< whether the particle may touch an obstacle in the step
    bool needsSweep = false;    ///< whether the step is too long for contacts to act as forces
    Vec3 force = Vec3::Zero();  ///< sum of the contact forces, N
};

/// Finds the contacts of a particle for a step of this duration (s). They need to be swept, which means integrated
/// along the path by small steps, where the particle may cover more than a fraction of a contact's depth in the step,
/// or where contacts act as explicit forces and the step is near the limit of stability. What matters is the motion
/// relative to each surface.
/// @param loads  where the loads of half the duration are recorded, for obstacles of which they are; may be null
Contacts contactsInStep(const Obstacles& obstacles, const Probe& particle, double duration, bool isExplicit,
                        ContactLoads* loads = nullptr);

/// Moves a particle for a duration (s) under the forces of the obstacles alone. At any finite speed its center stays on
/// the side of a plane, of a box's face and of a sphere that it came from. Where a scaled wall cannot stop it, it
/// rebounds at the surface. Where the repulsor of a paper's wall cannot stop it, it is reflected at a barrier under the
/// surface, which is a departure from the paper. Under a plane that barrier lies at the law's core distance from the
/// repulsor, in a solid a tenth of the particle's radius or of half the solid's thickness under the surface. The error
/// is of second order in the duration. Returns how often a scaled wall held the center at its surface.
/// @param loads  where the loads are recorded, for obstacles of which they are; may be null
int advanceThroughContacts(const Obstacles& obstacles, Probe& particle, double duration, ContactLoads* loads = nullptr);

}  // namespace engine
