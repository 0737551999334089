// Where the time of a picture goes, stage by stage. Filled in by the Renderer and the picture pass, read by the
// studies.
#pragma once

#include <chrono>

namespace render {

/// Wall-clock seconds of one picture; a stage that the view does not need takes next to nothing. The first three stages
/// run side by side: together they may take more than the picture did, and a stage may include what its thread did for
/// another stage while it waited.
struct DrawTimes {
    double bin = 0.0;        ///< balls of the skin, spheres, boxes, lines and ground to tiles
    double occlusion = 0.0;  ///< sky visibility
    double shadow = 0.0;     ///< the light's grid of spheres and depth map of the metaballs
    double cast = 0.0;       ///< ray casting of metaballs
    double color = 0.0;      ///< primary hits and shading
    double openGl = 0.0;     ///< upload of the pixels
    double readBack = 0.0;
};

/// A stopwatch: add() adds the seconds since the last call, or since construction, to a stage.
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

/// Adds the seconds that some work takes to a stage.
template <typename Work>
void timed(double& seconds, const Work& work) {
    StageClock clock;
    work();
    clock.add(seconds);
}

}  // namespace render
