// Where the time of a picture goes, stage by stage. Filled in by the Renderer and its stages, read by the
// studies.
#pragma once

#include <chrono>

namespace render {

/// Wall-clock seconds of the stages of one picture; a stage that the view does not need takes next to nothing. The
/// first four stages run side by side: together they may take more than the picture did, and a stage may include what
/// its thread did for another stage while it waited.
struct DrawTimes {
    double bin = 0.0;        ///< sorting balls, spheres, boxes, lines and ground into tiles
    double occlusion = 0.0;  ///< computing the sky visibility
    double shadow = 0.0;     ///< building the light's grid of spheres and the depth maps of metaballs and meshes
    double rays = 0.0;       ///< sorting balls and triangles for the rays through transparent bodies
    double cast = 0.0;       ///< ray casting of metaballs
    double color = 0.0;      ///< primary hits and shading
    double upload = 0.0;     ///< handing the prepared view over to OpenGL
    double readBack = 0.0;   ///< making the image of the pixels
};

/// Adds the seconds that work() takes to the time of a stage.
template <typename Work>
void timed(double& seconds, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace render
