#include "tools/mesh/scene_metaballs.h"

#include <algorithm>
#include <limits>

#include "scenes/view/frame_view.h"

namespace tools {
namespace {

/// The radius that cells are measured in, m. Infinity if the scene never has particles.
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

}  // namespace

Lattice latticeOf(const scenes::Scene& scene, double cell) {
    const double radius = cellRadius(scene);
    const engine::Vec3 origin = scenes::viewOrigin(scene, 0.0);
    return {cell * (radius < std::numeric_limits<double>::infinity() ? radius : 1.0),
            {origin.x(), origin.y(), origin.z()}};
}

render::View metaballsOf(const scenes::Scene& scene, const engine::Simulation& simulation, const Lattice& lattice) {
    render::View view = scene.look.common;
    const glm::dvec3& origin = lattice.origin;
    view.particles = scenes::drawnParticles(scene, simulation, engine::Vec3(origin.x, origin.y, origin.z));
    return view;
}

}  // namespace tools
