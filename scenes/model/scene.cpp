// Computes how many frames the animation of a scene has, and which time each of them shows.
#include "scenes/model/scene.h"

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

int nearestFrame(const Scene& scene, double time) {
    return std::clamp(static_cast<int>(std::lround(scene.fps.framesIn(time))), 0, frameCount(scene) - 1);
}

}  // namespace

int frameCount(const Scene& scene) {
    return std::max(1, static_cast<int>(std::lround(scene.fps.framesIn(scene.duration))));
}

double frameTime(const Scene& scene, int frame) {
    return scene.fps.timeOf(frame);
}

int stillFrame(const Scene& scene) {
    return nearestFrame(scene, scene.stillTime);
}

std::vector<int> stripFrames(const Scene& scene) {
    std::vector<int> frames;
    for (const double time : scene.stripTimes) {
        const int frame = nearestFrame(scene, time);
        if (frames.empty() || frames.back() < frame) frames.push_back(frame);
    }
    return frames;
}

}  // namespace scenes
