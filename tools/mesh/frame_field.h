// The file of a frame's metaball field, which `globular simulate --format vdb` writes.
#pragma once

#include <string>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"

namespace tools {

/// The bytes of a .vdb file with the field of the scene's metaballs at the simulation's present state: a fog volume
/// "density" with voxels of half a radius of the smallest particles, as render::encodeField() writes it. The same for
/// any number of threads.
/// @param frame  number of the frame that the state belongs to
/// @throws render::SystemError if there is no OpenVDB
/// @throws MemoryError if memory runs out
std::string encodeFrameField(const scenes::Scene& scene, const engine::Simulation& simulation, int frame);

}  // namespace tools
