// The moments at which a run exchanges heat. Between them particles move at the constants that they have; at each of
// them, in this order,
// - what damping, friction and rebounds have taken from the energy of motion becomes heat of those that are damped at
//   that moment, in proportion, as soon as it is enough to be noticed;
// - heat flows for the time since the moment before (heat/heat_exchange.h);
// - particles that melt or set get the constants of their new stage. What that changes of their energy at the places
//   where they are is paid by their heat, so that the sum of all energies stays.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// The next moment at which heat is exchanged, s; infinite in a run without heat.
double nextHeatMoment(const Simulation& simulation);

/// Whether heat is to be exchanged at this time (s).
bool isHeatDueAt(const Simulation& simulation, double time);

/// Exchanges the heat of an interval at the present time, at which it must be due. Returns whether particles have got
/// other constants; forces and energies are then unknown.
bool exchangeHeatDue(Simulation& simulation);

}  // namespace engine
