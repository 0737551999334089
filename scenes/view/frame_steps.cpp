// Frame times are frame / fps, so the frame that a simulation stands at can be read off its time.
#include "scenes/view/frame_steps.h"

#include <cmath>

namespace scenes {

void advanceToFrame(const Scene& scene, engine::Simulation& simulation, int frame) {
    const int present = static_cast<int>(std::lround(simulation.time * scene.fps));
    for (int next = present + 1; next <= frame; ++next) engine::advance(simulation, frameTime(scene, next));
}

}  // namespace scenes
