// The warning that particles have left the scene and are still computed. Printed at the end of runs and by `check`.
#pragma once

#include <cstdint>
#include <string>

#include "engine/state/simulation.h"

namespace tools {

/// What to say of particles that have left the scene (engine/run/strays.h).
std::string strayWarning(std::uint64_t count);

/// Prints a warning if particles have left the scene.
void warnOfStrays(const engine::Simulation& simulation);

}  // namespace tools
