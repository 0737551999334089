// Particles take the color of their material, speed or age; planes are seen only as the look's ground; containers and
// boxes may show their edges.
#include "scenes/view/frame_view.h"

#include <array>
#include <cmath>

#include "scenes/text/color.h"
#include "scenes/view/overlay_view.h"
#include "scenes/view/single.h"

namespace scenes {
namespace {

using engine::Vec3;

/// What the color of a particle shows, in the unit of the look's range.
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

/// Corner number 0 to 7: bit 0, 1 and 2 choose the maximum in x, y and z.
glm::vec3 cornerOf(const BoxExtent& box, unsigned corner) {
    return {(corner & 1U) != 0 ? box.maximum.x : box.minimum.x, (corner & 2U) != 0 ? box.maximum.y : box.minimum.y,
            (corner & 4U) != 0 ? box.maximum.z : box.minimum.z};
}

/// Twelve edges: from every corner along each axis in which it is at the minimum.
void addEdges(const BoxExtent& box, const glm::vec3& color, float width, render::View& view) {
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned axis = 1; axis < 8; axis *= 2)
            if ((corner & axis) == 0)
                view.edges.push_back({cornerOf(box, corner), cornerOf(box, corner | axis), color, width});
}

void addObstacle(const Scene& scene, std::size_t index, render::View& view) {
    const ObstacleLook& seen = scene.obstacleLooks.at(index);
    const engine::Obstacle& obstacle = scene.setup.obstacles.shapes[index];
    if (!seen.visible) return;
    const float width = single(scene.look.edgeWidth);
    if (const auto* sphere = std::get_if<engine::Sphere>(&obstacle)) {
        view.sphereObstacles.push_back({single(sphere->center), single(sphere->radius), single(seen.color)});
    } else if (const auto* box = std::get_if<engine::Box>(&obstacle)) {
        const BoxExtent extent{single(box->minimum), single(box->maximum)};
        view.boxObstacles.push_back({extent.minimum, extent.maximum, single(seen.color)});
        if (seen.edges) addEdges(extent, single(scene.look.edgeColor), width, view);
    } else if (const auto* container = std::get_if<engine::Container>(&obstacle)) {
        const BoxExtent extent{single(container->minimum), single(container->maximum)};
        if (seen.edges) addEdges(extent, single(seen.color), width, view);
    }
}

render::Camera cameraOf(const CameraPlacement& placement) {
    render::Camera camera;
    camera.projection = placement.projection;
    camera.eye = single(placement.eye);
    camera.target = single(placement.target);
    camera.up = single(placement.up);
    camera.verticalFov = single(placement.verticalFov);
    camera.halfHeight = single(placement.halfHeight);
    return camera;
}

/// The ground fades from below the point that the camera looks at.
render::Ground groundOf(const Look& look, const Vec3& target) {
    render::Ground ground;
    ground.height = single(look.groundHeight);
    ground.color = single(look.groundColor);
    ground.center = single(Vec3(target.x(), look.groundHeight, target.z()));
    ground.fadeDistance = single(look.groundFade);
    return ground;
}

void addLook(const Look& look, render::View& view) {
    view.style = look.style;
    view.field = {single(look.metaballReach), look.skin};
    view.light = {single(look.toLight), single(look.lightColor), look.shadows, single(look.shadowSoftness)};
    view.ambient = {single(look.ambientSky), single(look.ambientGround), single(look.occlusion)};
    view.surface = {single(look.specular),  look.glossExponent,        single(look.reflection), single(look.metal),
                    single(look.roughness), single(look.translucency), single(look.absorption), single(look.glow)};
    view.surroundings = {single(look.mirrorTop), single(look.mirrorHorizon), single(look.mirrorBottom)};
    view.exposure = single(look.exposure);
    view.background = {single(look.backgroundTop), single(look.backgroundBottom)};
}

}  // namespace

render::View frameView(const Scene& scene, const engine::Particles& particles, double time) {
    render::View view;
    addLook(scene.look, view);
    const CameraPlacement camera = cameraAt(scene.camera, time);
    view.camera = cameraOf(camera);
    if (scene.look.ground) view.ground = groundOf(scene.look, camera.target);
    view.overlay = overlayOf(scene, time);
    for (std::size_t index = 0; index < scene.setup.obstacles.shapes.size(); ++index) addObstacle(scene, index, view);
    view.particles.reserve(particles.count());
    for (std::size_t index = 0; index < particles.count(); ++index)
        view.particles.push_back({single(particles.position[index]), single(particles.radius[index]),
                                  single(particleColor(scene, particles, index, time))});
    return view;
}

render::View frameView(const Scene& scene, const engine::Simulation& simulation) {
    return frameView(scene, simulation.particles, simulation.time);
}

}  // namespace scenes
