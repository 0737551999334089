// Warnings about the start of a scene: particles and emitters inside obstacles, between obstacles without room, or
// within one another, containers that contradict each other, and a camera that sees nothing. Such a scene is valid, but
// shows what its author is not likely to mean. Called by the commands that run a scene.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace scenes {

/// Messages on what is not likely to be meant, each with the position of a table in the scene file and what to change.
/// Counts are exact unless a message says "about": in scenes with very many particles within each other, or with very
/// many obstacles, only a sample of the particles is examined. Takes about a second for a million particles on one
/// thread.
std::vector<std::string> startWarnings(const Scene& scene);

/// What to say where the automatic stepper misses the wanted error.
/// @param error  what was estimated, radii per second of motion
std::string missedErrorWarning(const Scene& scene, double error);

}  // namespace scenes
