// The length of the cell and the origin are the scene's, not the frame's, so that the lattice stays in its place.
#include "tools/mesh/frame_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "render/mesh/isosurface.h"
#include "render/mesh/mesh_files.h"
#include "render/mesh/surface_mesh.h"
#include "render/picture/system_error.h"
#include "scenes/model/to_float.h"
#include "scenes/view/frame_view.h"
#include "tools/system/memory.h"

namespace tools {
namespace {

glm::dvec3 vectorOf(const engine::Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// The smallest radius of the scene's particles, but at least a tenth of the largest: a few very small ones must not
/// make the mesh of all others a hundred times as fine. Infinity if the scene never has particles.
double cellRadius(const scenes::Scene& scene) {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;
    const auto add = [&](double radius) {
        if (!(radius > 0.0)) return;
        smallest = std::min(smallest, radius);
        largest = std::max(largest, radius);
    };
    for (const double radius : scene.setup.initial.radius) add(radius);
    for (const engine::Emitter& emitter : scene.setup.emitters) add(scene.setup.materials[emitter.material].radius);
    return std::max(smallest, 0.1 * largest);
}

const char* nameOf(render::Skin skin) {
    return skin == render::Skin::smooth ? "smooth" : "plain";
}

}  // namespace

FrameMesher::FrameMesher(const scenes::Scene& scene, const MeshSettings& settings)
    : scene_(scene), settings_(settings), origin_(vectorOf(scenes::viewOrigin(scene, 0.0))) {
    render::requireOpenVdb();
    const double radius = cellRadius(scene);
    cell_ = settings.cell * (radius < std::numeric_limits<double>::infinity() ? radius : 1.0);
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
    json["cell_m"] = cell_;
    json["metaball_reach"] = field.reach;
    json["skin"] = nameOf(field.skin);
    json["frames"] = Json::array();
    return json;
}

FrameMesh FrameMesher::meshOf(const engine::Simulation& simulation, int frame) const {
    const engine::Particles& particles = simulation.particles;
    const auto purpose = [&] { return fmt::format("meshing {} particles", particles.count()); };
    return withMemoryFor(purpose, "choose a larger --cell, or simulate fewer particles", [&] {
        render::View view = scene_.look.common;
        view.particles = scenes::drawnParticles(scene_, simulation, engine::Vec3(origin_.x, origin_.y, origin_.z));
        std::vector<glm::vec3> velocities;
        velocities.reserve(particles.count());
        for (const engine::Vec3& velocity : particles.velocity) velocities.push_back(scenes::toFloat(velocity));
        const render::TriangleMesh mesh = render::surfaceMesh(view, velocities, cell_);
        return FrameMesh{encoded(mesh, simulation.time, frame),
                         {{"frame", frame},
                          {"vertices", mesh.positions.size()},
                          {"triangles", mesh.triangles.size()},
                          {"volume", render::volumeOf(mesh)}}};
    });
}

std::string FrameMesher::encoded(const render::TriangleMesh& mesh, double time, int frame) const {
    if (settings_.format == "vdb") return render::encodeLevelSet(mesh, {cell_, origin_, time, frame, scene_.sceneHash});
    const render::MeshLabel label{origin_,
                                  {"globular mesh", fmt::format("frame {}", frame), fmt::format("time {} s", time),
                                   fmt::format("scene_hash {}", scene_.sceneHash)}};
    return settings_.format == "obj" ? render::encodeObj(mesh, label) : render::encodePly(mesh, label);
}

}  // namespace tools
