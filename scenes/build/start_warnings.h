// Warnings about where the particles of a scene start: inside obstacles, between obstacles without room, or within one
// another. Such a scene is valid, but its particles are shot out at once, with many short steps. Called by the commands
// that run a scene.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace scenes {

/// Messages on bodies and emitters that start where they are not likely to be meant, and on emitters that are asked for
/// more than fits (emission_warnings.h), each with the position of a
/// [[body]], [[emitter]] or [[obstacle]] in the scene file. Counts are exact unless a message says "about": in scenes
/// with very many particles within each other, or with very many obstacles, only a sample of the particles is examined.
/// Takes about a second for a million particles on one thread.
std::vector<std::string> startWarnings(const Scene& scene);

}  // namespace scenes
