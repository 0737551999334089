// A run of a scene kept whole: every frame, the state at its end, what it took, and how it failed if it did. The
// observables look at runs; nothing else starts one for them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// How a run ended before its time.
struct Failure {
    double time = 0.0;  ///< s
    std::string message;
};

struct Run {
    std::vector<engine::Particles> frames;  ///< from frame 0 to the scene's end, or as far as it came
    std::vector<std::uint64_t> stepsUntil;  ///< taken until each frame
    engine::Simulation end;
    double seconds = 0.0;  ///< of simulating
    std::optional<Failure> failure;
};

/// Runs a scene with its own stepper from frame 0 to the frame at its duration, that one included.
/// A run that becomes unstable is returned with its failure.
Run runScene(const scenes::Scene& scene);

}  // namespace studies
