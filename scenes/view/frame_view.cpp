// Everything that all frames of an animation have in common has been built together with the scene. What is added here
// changes from frame to frame: the camera, the particles with their colors, the time stamp, and the point that all
// positions are relative to.
#include "scenes/view/frame_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/model/to_float.h"
#include "scenes/text/color.h"

namespace scenes {
namespace {

using engine::Vec3;

Vec3 particleColor(const Scene& scene, const engine::Particles& particles, std::size_t index, double time) {
    const Look& look = scene.look;
    if (look.colorBy == ColorBy::material) return scene.materialColors.at(particles.material[index]);
    const double quantity = look.colorBy == ColorBy::age ? time - particles.birthTime[index]
                                                         : std::sqrt(engine::squaredLength(particles.velocity[index]));
    return rampColor(look.ramp, (quantity - look.rampLow) / (look.rampHigh - look.rampLow));
}

/// The point that the positions of a view are relative to, so that single precision is fine enough for them wherever
/// the scene lies. It is the point nearest to the camera's target of a lattice whose points are at least 256 times as
/// far apart as half the height of the picture: the origin in most scenes, and the same for all frames while the camera
/// does not travel far. A float is then off by at most 2^-16 of half that height, 1/170 of a pixel of a picture with
/// 768 rows.
Vec3 originOf(const CameraPlacement& camera) {
    int exponent = 0;
    std::frexp(halfHeightAtTarget(camera), &exponent);
    const double spacing = std::ldexp(256.0, exponent);
    Vec3 origin;
    for (int axis = 0; axis < 3; ++axis) origin[axis] = spacing * std::round(camera.target[axis] / spacing);
    return origin;
}

render::Camera cameraOf(const CameraPlacement& placement, const Vec3& origin) {
    return {.projection = placement.projection,
            .eye = toFloat(placement.eye - origin),
            .target = toFloat(placement.target - origin),
            .up = toFloat(placement.up),
            .verticalFov = toFloat(placement.verticalFov),
            .halfHeight = toFloat(placement.halfHeight)};
}

/// A corner of a box by its number from 0 to 7: bits 0, 1 and 2 of the number select the maximum in x, y and z.
glm::vec3 cornerOf(const render::BoxObstacle& box, unsigned corner) {
    return {(corner & 1U) != 0 ? box.maximum.x : box.minimum.x, (corner & 2U) != 0 ? box.maximum.y : box.minimum.y,
            (corner & 4U) != 0 ? box.maximum.z : box.minimum.z};
}

/// Adds a box's twelve edges, each once: from every corner along each axis in which the corner is at the minimum.
void addEdges(const render::BoxObstacle& box, const glm::vec3& color, float width, render::View& view) {
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned axis = 1; axis < 8; axis *= 2)
            if ((corner & axis) == 0)
                view.edges.push_back({cornerOf(box, corner), cornerOf(box, corner | axis), color, width});
}

/// Adds what is drawn of the obstacles.
void addObstacles(const Look& look, const Vec3& origin, render::View& view) {
    for (const DrawnSphere& sphere : look.spheres)
        view.sphereObstacles.push_back({toFloat(sphere.center - origin), toFloat(sphere.radius), sphere.color});
    for (const DrawnBox& drawn : look.boxes) {
        const render::BoxObstacle box{toFloat(drawn.minimum - origin), toFloat(drawn.maximum - origin),
                                      drawn.faces.value_or(glm::vec3(0.0F))};
        if (drawn.faces) view.boxObstacles.push_back(box);
        if (drawn.edges) addEdges(box, *drawn.edges, look.edgeWidth, view);
    }
}

}  // namespace

void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame) {
    // The time of a frame is its index / fps, so the index of the current frame follows from the time.
    const int current = static_cast<int>(std::lround(scene.fps.framesIn(simulation.time)));
    for (int next = current + 1; next <= frame; ++next) engine::advance(simulation, frameTime(scene, next));
}

std::string timeText(const Scene& scene, double time) {
    // Frames are 1/fps apart: two decimals distinguish their times up to 100 frames per second.
    return fmt::format("t = {:.{}f} s", time, scene.fps.framesIn(1.0) > 100.0 ? 3 : 2);
}

Vec3 viewOrigin(const Scene& scene, double time) {
    return originOf(cameraAt(scene.camera, time));
}

std::vector<render::Sphere> drawnParticles(const Scene& scene, const engine::Simulation& simulation,
                                           const Vec3& origin) {
    const engine::Particles& particles = simulation.particles;
    std::vector<render::Sphere> drawn;
    drawn.reserve(particles.count());
    for (std::size_t index = 0; index < particles.count(); ++index)
        drawn.push_back({toFloat(particles.position[index] - origin), toFloat(particles.radius[index]),
                         toFloat(particleColor(scene, particles, index, simulation.time))});
    return drawn;
}

render::View frameView(const Scene& scene, const engine::Simulation& simulation) {
    const double time = simulation.time;
    render::View view = scene.look.common;
    const CameraPlacement camera = cameraAt(scene.camera, time);
    const Vec3 origin = originOf(camera);
    view.camera = cameraOf(camera, origin);
    if (view.ground) {
        view.ground->height = toFloat(scene.look.groundHeight - origin.y());
        // The ground fades with the distance from the point below the camera's target.
        view.ground->center = {view.camera.target.x, view.ground->height, view.camera.target.z};
    }
    addObstacles(scene.look, origin, view);
    if (scene.look.hasTimeStamp) view.overlay.stamp = timeText(scene, time);
    view.particles = drawnParticles(scene, simulation, origin);
    return view;
}

double depthRange(const Scene& scene) {
    double farthest = 0.0;
    for (const CameraKey& key : scene.camera)
        farthest = std::max(farthest, std::sqrt(engine::squaredLength(key.placement.target - key.placement.eye)));
    return 4.0 * farthest;
}

}  // namespace scenes
