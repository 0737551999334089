// The file of a frame's mesh: the surface of the scene's metaballs at the state of a simulation. Used by `globular
// mesh`.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/state/simulation.h"
#include "render/mesh/triangle_mesh.h"
#include "scenes/model/scene.h"
#include "tools/frames/frame_names.h"
#include "tools/mesh/scene_metaballs.h"
#include "tools/system/json.h"

namespace tools {

/// The formats of mesh files, which are their extensions, too.
inline constexpr std::array kMeshFormats = {"ply", "obj", "vdb"};

struct MeshSettings {
    double cell = kDefaultCell;  ///< distance of neighboring nodes of the lattice, in radii of the smallest particles
    std::string format = "ply";  ///< one of kMeshFormats
};

/// The bytes of a mesh file, and what is in it.
struct FrameMesh {
    std::string bytes;
    Json facts;  ///< frame, vertices, triangles and volume (m^3), for run.json
};

/// Makes the meshes of a scene's frames.
class FrameMesher {
 public:
    /// @param scene  must outlive the mesher
    /// @throws render::SystemError in a build without OpenVDB
    FrameMesher(const scenes::Scene& scene, const MeshSettings& settings);

    /// How the files are named.
    FrameNames names() const;

    /// What determines the bytes of the files beside the scene and its states.
    Json identity() const;

    /// What the mesh is of, for run.json.
    Json description() const;

    /// The mesh of the simulation's present state. The same for any number of threads.
    /// @param frame  number of the frame that the state belongs to
    /// @throws MemoryError if memory runs out
    FrameMesh meshOf(const engine::Simulation& simulation, int frame) const;

 private:
    std::string encoded(const render::TriangleMesh& mesh, double time, int frame) const;

    const scenes::Scene& scene_;
    MeshSettings settings_;
    Lattice lattice_;
};

}  // namespace tools
