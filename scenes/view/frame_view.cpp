// Everything that all frames of an animation have in common has been built together with the scene. What is added here
// changes from frame to frame: the camera, the particles with their colors, and the time stamp.
#include "scenes/view/frame_view.h"

#include <fmt/format.h>

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

render::Camera cameraOf(const CameraPlacement& placement) {
    return {.projection = placement.projection,
            .eye = toFloat(placement.eye),
            .target = toFloat(placement.target),
            .up = toFloat(placement.up),
            .verticalFov = toFloat(placement.verticalFov),
            .halfHeight = toFloat(placement.halfHeight)};
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

render::View frameView(const Scene& scene, const engine::Simulation& simulation) {
    const engine::Particles& particles = simulation.particles;
    const double time = simulation.time;
    render::View view = scene.look.common;
    view.camera = cameraOf(cameraAt(scene.camera, time));
    // The ground fades with the distance from the point below the camera's target.
    if (view.ground) view.ground->center = {view.camera.target.x, view.ground->height, view.camera.target.z};
    if (scene.look.hasTimeStamp) view.overlay.stamp = timeText(scene, time);
    view.particles.reserve(particles.count());
    for (std::size_t index = 0; index < particles.count(); ++index)
        view.particles.push_back({toFloat(particles.position[index]), toFloat(particles.radius[index]),
                                  toFloat(particleColor(scene, particles, index, time))});
    return view;
}

}  // namespace scenes
