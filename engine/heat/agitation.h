// Random motion of the particles of a material with cohesion, which keeps it liquid: at rest, drops of soft particles
// set like a jammed solid, and no surface tension rounds them off. The paper has no random motion. Between steps, at
// moments of their own, pairs get random impulses along the line between them, which keep momentum and angular
// momentum. They give back what damping takes: with a variance of
//     2 b_d s_d E dt    for a time dt
// the particles' mean kinetic energy is 3/2 E, whatever the damping. Source: the random force of dissipative particle
// dynamics (Espanol and Warren, Europhys. Lett. 30, 1995), here summed over an interval.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Energy E of the random motion in a material, J: what k_B T is to a fluid of molecules. It is given as a share of
/// sigma D0^2, by which drops of any size and tension are alike: their surfaces are rough by about sqrt(E/sigma).
double agitationEnergy(const Material& material);

/// Longest time between two moments at which a material is agitated, s; infinite where it is not. In this time damping
/// takes at most four tenths of the energy of random motion.
double agitationInterval(const Material& material);

/// The next moment at which particles are agitated, s; infinite in a run without agitation.
double nextAgitation(const Simulation& simulation);

/// Whether particles are to be agitated at this time (s).
bool isAgitationDueAt(const Simulation& simulation, double time);

/// Gives the particles the impulses of an interval at the present time, at which they must be due. The forces are then
/// unknown, and the energy is known if it was.
void agitateDue(Simulation& simulation);

}  // namespace engine
