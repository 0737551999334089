// The metaballs of a scene's frames, and the lattice on which meshes and fields of all its frames are sampled: length
// of the cell and origin are the scene's, not the frame's, so that the lattice stays in its place.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "engine/state/simulation.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"

namespace tools {

/// Length of the cell where none is given, in radii of the smallest particles.
inline constexpr double kDefaultCell = 0.5;

struct Lattice {
    double cell = 1.0;       ///< distance of neighboring nodes, m
    glm::dvec3 origin{0.0};  ///< of its nodes, and what the positions of metaballs are relative to, m
};

/// The lattice of a scene.
/// @param cell  distance of neighboring nodes, in radii of the scene's smallest particles, but of those at least a
/// tenth
///              as large as the largest: a few very small ones must not make the lattice a hundred times as fine
Lattice latticeOf(const scenes::Scene& scene, double cell);

/// The particles of a simulation's present state, and which field of metaballs the scene makes of them, whatever its
/// style is.
render::View metaballsOf(const scenes::Scene& scene, const engine::Simulation& simulation, const Lattice& lattice);

/// The name of a skin in scene files.
const char* nameOf(render::Skin skin);

/// A line that says which metaballs a file of a scene is of where pictures show none, since they show spheres; empty
/// for a scene that is drawn as metaballs.
/// @param file  what it is, such as "the mesh"
std::string metaballsNote(const scenes::Scene& scene, const char* file);

}  // namespace tools
