// What the emitters of a run were asked for and what they emitted, for run.json and the summary of a run.
#pragma once

#include <string>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"
#include "tools/system/json.h"

namespace tools {

/// For each emitter the numbers of particles asked for until now, born, and refused: asked for and not born.
Json emittersJson(const engine::Simulation& simulation);

/// Names the first emitter that has missed the rate that the scene gives, such as "emitter 2: asked 500/s, 36/s fit",
/// and counts the others; empty if there is none. An emitter without a rate emits what fits
/// and misses nothing.
std::string missedRates(const scenes::Scene& scene, const engine::Simulation& simulation);

}  // namespace tools
