// Groups of particles in free fall, far from all others: what keeps them from setting the length of everybody's steps.
// A group on which nothing but gravity acts moves along a parabola, and every stepper follows a parabola exactly at any
// step. So only motion relative to the group counts. Used by the audit of steps; the groups themselves are those of the
// force evaluator.
#pragma once

#include <vector>

#include "engine/stepping/step_cache.h"

namespace engine {

/// Divides the particles into groups that are far from each other (neighbors/far_groups.h). Called at the start of a
/// run and after every interval, so that the groups depend on the state alone and a resumed run has the same.
void renewGroups(Simulation& simulation);

/// Energies of the common motion of each group in the present state.
std::vector<GroupEnergy> groupEnergies(const Simulation& simulation);

/// For each group, whether no obstacle was in the way of any of its particles in the last step.
/// @param before  positions before the step, in meters
std::vector<bool> groupsInFreeFall(const Simulation& simulation, const std::vector<Vec3>& before);

/// How far each group's leader has moved in a step, m.
/// @param before  positions before the step, in meters
std::vector<Vec3> motionsOfGroups(const Simulation& simulation, const std::vector<Vec3>& before);

/// Whether no two groups have come near each other in a step in which every particle stayed within its radius of where
/// its group's first particle carried it.
/// @param before  positions before the step, in meters
bool haveStayedApart(const Simulation& simulation, const std::vector<Vec3>& before);

}  // namespace engine
