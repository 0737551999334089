// Straight motion among obstacles whose surfaces no center of a particle may pass (continuous collision detection). The
// forces of scaled walls slow particles down before they get there; what is too heavy, too fast or pressed too hard for
// them is stopped here, whatever the step.
#pragma once

#include "engine/obstacles/contact_loads.h"
#include "engine/obstacles/obstacles.h"

namespace engine {

/// What happens to the velocity of a particle whose center arrives at a surface.
enum class Arrival {
    slides,   ///< the part along the normal is lost, so that what presses on the surface comes to rest there
    rebounds  ///< that part is reflected with the restitution of the surface
};

/// Moves a particle along its velocity for a duration (s). Where its center arrives at the surface of an obstacle, the
/// velocity relative to the surface changes, by Coulomb friction too, and the particle goes on for the rest of the
/// duration. An obstacle in which the center already lies does not hold it. Kinetic energy, in the frame of the
/// surface, never grows. Returns how often a surface held it.
/// @param loads  where the loads are recorded, for obstacles of which they are; may be null
int moveAmongBarriers(const Obstacles& obstacles, Probe& particle, double duration, Arrival arrival,
                      ContactLoads* loads = nullptr);

}  // namespace engine
