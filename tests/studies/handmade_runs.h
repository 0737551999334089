// Runs made by hand, for observables whose values can be worked out on paper. Included by the tests of the observables.
#pragma once

#include <string>
#include <vector>

#include "scenes/build/read_scene.h"
#include "studies/stability/observables.h"

namespace studies_test {

using engine::Vec3;

/// A particle of a frame.
struct Dot {
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    double mass = 1.0;
};

/// A frame of particles with radius 0.5.
inline engine::Particles frameOf(const std::vector<Dot>& dots) {
    engine::Particles particles;
    for (const Dot& dot : dots)
        append(particles, {.position = dot.position, .velocity = dot.velocity, .radius = 0.5, .mass = dot.mass});
    return particles;
}

/// A run of these frames, with one step between neighboring frames.
inline studies::Run runOf(const std::vector<engine::Particles>& frames) {
    studies::Run run;
    run.frames = frames;
    for (std::size_t k = 0; k < frames.size(); ++k) run.stepsUntil.push_back(k);
    return run;
}

/// A scene of one ball in empty space without gravity, with more TOML appended to its text.
inline scenes::Scene sceneWith(const std::string& more, const scenes::Overrides& overrides = {}) {
    const std::string text =
        "title = \"t\"\nduration = 0.5\nfps = 60\n[physics]\ngravity = [0, 0, 0]\n[[body]]\nshape = \"ball\"\nradius = "
        "0.6\n";
    return scenes::readScene(text + more, "t.toml", overrides);
}

}  // namespace studies_test
