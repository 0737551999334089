// What went softly wrong in a run: nothing that ends it, but something that its author did not ask for. Printed at the
// end of runs, written into run.json, and said by `check`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"

namespace tools {

/// What to say of particles that have left the scene (engine/run/strays.h).
std::string strayWarning(std::uint64_t count);

/// Prints a warning if particles have left the scene.
void warnOfStrays(const engine::Simulation& simulation);

/// Whether the automatic stepper's mean error (radii per second of motion) is so far above the wanted one that it has
/// missed it.
bool isErrorMissed(double error, double wanted);

/// What went softly wrong up to the present state of a run, one phrase for each kind: rates of emission that did not
/// fit, an error above the wanted one, contacts that the barrier of an obstacle held, and centers beyond a surface.
std::vector<std::string> troublesOf(const scenes::Scene& scene, const engine::Simulation& simulation);

/// The troubles as a line of a summary, "trouble: ...", with its line break; empty if there are none.
std::string troubleLine(const scenes::Scene& scene, const engine::Simulation& simulation);

}  // namespace tools
