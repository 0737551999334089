// Particles are colored by material, speed or age. Planes are not drawn, except for the ground of the look; boxes and
// containers may have edges.
#include "scenes/view/frame_view.h"

#include <cmath>

#include "scenes/model/to_float.h"
#include "scenes/text/color.h"
#include "scenes/view/overlay_view.h"

namespace scenes {
namespace {

using engine::Vec3;

/// The speed (m/s) or age (s) of a particle, whichever its color shows.
double shownQuantity(const Look& look, const engine::Particles& particles, std::size_t index, double time) {
    if (look.colorBy == ColorBy::age) return time - particles.birthTime[index];
    return std::sqrt(engine::squaredLength(particles.velocity[index]));
}

Vec3 particleColor(const Scene& scene, const engine::Particles& particles, std::size_t index, double time) {
    const Look& look = scene.look;
    if (look.colorBy == ColorBy::material) return scene.materialColors.at(particles.material[index]);
    const double quantity = shownQuantity(look, particles, index, time);
    return rampColor(look.ramp, (quantity - look.rampLow) / (look.rampHigh - look.rampLow));
}

struct BoxExtent {
    glm::vec3 minimum{0.0F};
    glm::vec3 maximum{0.0F};
};

/// A corner by its number from 0 to 7: bits 0, 1 and 2 select the maximum in x, y and z.
glm::vec3 cornerOf(const BoxExtent& box, unsigned corner) {
    return {(corner & 1U) != 0 ? box.maximum.x : box.minimum.x, (corner & 2U) != 0 ? box.maximum.y : box.minimum.y,
            (corner & 4U) != 0 ? box.maximum.z : box.minimum.z};
}

/// Adds twelve edges: from every corner along each axis in which it is at the minimum.
void addEdges(const BoxExtent& box, const glm::vec3& color, float width, render::View& view) {
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned axis = 1; axis < 8; axis *= 2)
            if ((corner & axis) == 0)
                view.edges.push_back({cornerOf(box, corner), cornerOf(box, corner | axis), color, width});
}

void addObstacle(const Scene& scene, std::size_t index, render::View& view) {
    const ObstacleLook& appearance = scene.obstacleLooks.at(index);
    const engine::Obstacle& obstacle = scene.setup.obstacles.shapes[index];
    if (!appearance.isVisible) return;
    const float width = scene.look.edgeWidth;
    if (const auto* sphere = std::get_if<engine::Sphere>(&obstacle)) {
        view.sphereObstacles.push_back({toFloat(sphere->center), toFloat(sphere->radius), toFloat(appearance.color)});
    } else if (const auto* box = std::get_if<engine::Box>(&obstacle)) {
        const BoxExtent extent{toFloat(box->minimum), toFloat(box->maximum)};
        view.boxObstacles.push_back({extent.minimum, extent.maximum, toFloat(appearance.color)});
        if (appearance.hasEdges) addEdges(extent, scene.look.edgeColor, width, view);
    } else if (const auto* container = std::get_if<engine::Container>(&obstacle)) {
        const BoxExtent extent{toFloat(container->minimum), toFloat(container->maximum)};
        if (appearance.hasEdges) addEdges(extent, toFloat(appearance.color), width, view);
    }
}

render::Camera cameraOf(const CameraPlacement& placement) {
    render::Camera camera;
    camera.projection = placement.projection;
    camera.eye = toFloat(placement.eye);
    camera.target = toFloat(placement.target);
    camera.up = toFloat(placement.up);
    camera.verticalFov = toFloat(placement.verticalFov);
    camera.halfHeight = toFloat(placement.halfHeight);
    return camera;
}

}  // namespace

void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame) {
    // Frame times are frame / fps, so the current frame follows from the time.
    const int current = static_cast<int>(std::lround(simulation.time * scene.fps));
    for (int next = current + 1; next <= frame; ++next) engine::advance(simulation, frameTime(scene, next));
}

render::View frameView(const Scene& scene, const engine::Particles& particles, double time) {
    render::View view = scene.look.common;
    const CameraPlacement camera = cameraAt(scene.camera, time);
    view.camera = cameraOf(camera);
    // The ground fades with the distance from the point below the camera's target.
    if (view.ground) view.ground->center = {view.camera.target.x, view.ground->height, view.camera.target.z};
    view.overlay = overlayOf(scene, time);
    for (std::size_t index = 0; index < scene.obstacleLooks.size(); ++index) addObstacle(scene, index, view);
    view.particles.reserve(particles.count());
    for (std::size_t index = 0; index < particles.count(); ++index)
        view.particles.push_back({toFloat(particles.position[index]), toFloat(particles.radius[index]),
                                  toFloat(particleColor(scene, particles, index, time))});
    return view;
}

render::View frameView(const Scene& scene, const engine::Simulation& simulation) {
    return frameView(scene, simulation.particles, simulation.time);
}

}  // namespace scenes
