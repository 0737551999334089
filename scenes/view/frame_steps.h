// From one frame of a scene to another. Every loop over frames goes through here, drawn or not.
#pragma once

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace scenes {

/// Brings a simulation that stands at a frame of the scene to a later one, by way of all frames between them: the steps
/// divide each frame's interval, so a run that leaves pictures out has the same bits as one that draws them all.
/// Throws: engine::InstabilityError.
void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame);

}  // namespace scenes
