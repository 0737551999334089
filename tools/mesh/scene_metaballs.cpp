#include "tools/mesh/scene_metaballs.h"

#include <fmt/format.h>

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

/// Whether the scene file or an override gives a key.
bool isGiven(const scenes::Scene& scene, const std::string& path) {
    return std::ranges::any_of(scene.values, [&](const scenes::EffectiveValue& value) {
        return value.path == path && value.origin == scenes::ValueOrigin::given;
    });
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

const char* nameOf(render::Skin skin) {
    if (skin == render::Skin::anisotropic) return "anisotropic";
    return skin == render::Skin::smooth ? "smooth" : "plain";
}

std::string metaballsNote(const scenes::Scene& scene, const char* file) {
    if (scene.look.common.style == render::Style::metaballs) return "";
    const render::MetaballField& field = scene.look.common.field;
    const auto origin = [&](const char* key) { return isGiven(scene, key) ? "" : " (default)"; };
    return fmt::format(
        "the scene is drawn as spheres; {} is of metaballs with look.metaball_reach = {:g}{} and look.skin = "
        "\"{}\"{}\n",
        file, field.reach, origin("look.metaball_reach"), nameOf(field.skin), origin("look.skin"));
}

}  // namespace tools
