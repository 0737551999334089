// A scene and the particles of one moment to the renderer's input. Double becomes float here and nowhere else.
#pragma once

#include "engine/state/particles.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"

namespace scenes {

/// What the picture of a moment shows: particles, obstacles, camera, light. time: s, for colors by age.
render::View frameView(const Scene& scene, const engine::Particles& particles, double time);

/// The same for the present moment of a simulation of this scene.
render::View frameView(const Scene& scene, const engine::Simulation& simulation);

}  // namespace scenes
