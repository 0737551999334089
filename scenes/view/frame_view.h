// From a scene and a simulation to the frames of the animation: the state at a frame, and what the renderer draws of
// it. Double becomes float on this side of the program only.
#pragma once

#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"

namespace scenes {

/// Advances a simulation from the time of one frame to that of a later one. It passes through the times of all frames
/// in between, because the interval between two frames is divided into equal steps: a run that does not draw every
/// frame has the same bits as one that does.
/// @throws engine::InstabilityError
void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame);

/// A time as a text such as "t = 1.25 s", with as many decimals as distinguish the frames of the scene, at least two.
std::string timeText(const Scene& scene, double time);

/// The view of the scene at the current time of the simulation: particles, obstacles, camera, lights and overlay, and
/// what moves while the shutter is open. Its
/// positions are relative to a point near the camera's target where this is far away, so that a scene looks the same
/// there as at the origin; near the origin they are the scene's own.
render::View frameView(const Scene& scene, const engine::Simulation& simulation);

/// The point that the positions of a view are relative to at a time (s), which is the origin of most scenes.
engine::Vec3 viewOrigin(const Scene& scene, double time);

/// The particles at the current time of the simulation as a view has them.
/// @param origin  what their positions are to be relative to, m
std::vector<render::Sphere> drawnParticles(const Scene& scene, const engine::Simulation& simulation,
                                           const engine::Vec3& origin);

/// View depth that depth pictures with a fixed scale should reach, the same for all frames, m: four times the greatest
/// distance of a [camera] from its target. Chosen: what stands behind the target is seen, and the scale stays fine.
double depthRange(const Scene& scene);

}  // namespace scenes
