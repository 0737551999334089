// Where the time of a picture goes, stage by stage. Filled in by the Renderer and its passes, read by the studies.
#pragma once

#include <chrono>

namespace render {

/// Wall-clock seconds of one picture; a stage that the view does not need takes next to nothing. The first three run
/// side by side, so that together they may be more than the picture took, and one may hold what its thread did for
/// another while it waited.
struct DrawTimes {
    double bin = 0.0;        ///< skin and looks; spheres, boxes, lines and ground to tiles
    double occlusion = 0.0;  ///< how open to the sky the particles are
    double shadow = 0.0;     ///< the light's grid of spheres and its map of the metaballs
    double cast = 0.0;       ///< ray casting of metaballs on the CPU
    double color = 0.0;      ///< what the samples see, and its colors, on the CPU
    double openGl = 0.0;     ///< the pixels handed to OpenGL
    double readBack = 0.0;
};

/// Adds the time since its last call, or since it was made, to a stage.
class StageClock {
 public:
    void add(double& seconds) {
        const auto now = std::chrono::steady_clock::now();
        seconds += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

 private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Adds the time that some work takes to a stage.
template <typename Work>
void timed(double& seconds, const Work& work) {
    StageClock clock;
    work();
    clock.add(seconds);
}

}  // namespace render
