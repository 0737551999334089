#include "tools/mesh/frame_mesh.h"

#include <fmt/format.h>

#include "render/mesh/isosurface.h"
#include "render/mesh/mesh_files.h"
#include "render/mesh/surface_mesh.h"
#include "render/picture/system_error.h"
#include "scenes/model/to_float.h"
#include "tools/system/memory.h"

namespace tools {
namespace {}  // namespace

FrameMesher::FrameMesher(const scenes::Scene& scene, const MeshSettings& settings)
    : scene_(scene), settings_(settings), lattice_(latticeOf(scene, settings.cell)) {
    render::requireOpenVdb();
}

FrameNames FrameMesher::names() const {
    return meshNames(settings_.format);
}

Json FrameMesher::identity() const {
    return {{"format", settings_.format}, {"cell", settings_.cell}, {"openvdb", render::openVdbVersion()}};
}

Json FrameMesher::description() const {
    const render::MetaballField& field = scene_.look.common.field;
    Json json = identity();
    json["cell_m"] = lattice_.cell;
    json["metaball_reach"] = field.reach;
    json["skin"] = nameOf(field.skin);
    json["frames"] = Json::array();
    return json;
}

FrameMesh FrameMesher::meshOf(const engine::Simulation& simulation, int frame) const {
    const engine::Particles& particles = simulation.particles;
    const auto purpose = [&] { return fmt::format("meshing {} particles", particles.count()); };
    return withMemoryFor(purpose, "choose a larger --cell, or simulate fewer particles", [&] {
        const render::View view = metaballsOf(scene_, simulation, lattice_);
        std::vector<glm::vec3> velocities;
        velocities.reserve(particles.count());
        for (const engine::Vec3& velocity : particles.velocity) velocities.push_back(scenes::toFloat(velocity));
        const render::TriangleMesh mesh = render::surfaceMesh(view, velocities, lattice_.cell);
        return FrameMesh{encoded(mesh, simulation.time, frame),
                         {{"frame", frame},
                          {"vertices", mesh.positions.size()},
                          {"triangles", mesh.triangles.size()},
                          {"volume", render::volumeOf(mesh)}}};
    });
}

std::string FrameMesher::encoded(const render::TriangleMesh& mesh, double time, int frame) const {
    if (settings_.format == "vdb")
        return render::encodeLevelSet(mesh, {lattice_.cell, lattice_.origin, time, frame, scene_.sceneHash});
    const render::MeshLabel label{lattice_.origin,
                                  {"globular mesh", fmt::format("frame {}", frame), fmt::format("time {} s", time),
                                   fmt::format("scene_hash {}", scene_.sceneHash)}};
    return settings_.format == "obj" ? render::encodeObj(mesh, label) : render::encodePly(mesh, label);
}

}  // namespace tools
