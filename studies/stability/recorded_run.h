// A run of a scene of which every frame is kept, for the observables of the study of stability.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// Why a run ended before the scene did.
struct Failure {
    double time = 0.0;  ///< of the scene, s
    std::string message;
};

struct Run {
    std::vector<engine::Particles> frames;  ///< from frame 0 to the scene's end, or to the failure
    std::vector<std::uint64_t> stepsUntil;  ///< number of steps taken until each frame
    engine::Simulation end;                 ///< the state at the end
    double seconds = 0.0;                   ///< wall clock
    std::optional<Failure> failure;
};

/// Runs a scene with its own stepper from frame 0 to the frame at its duration, that frame included. World bounds are
/// ignored, because observables follow every particle. A run that becomes unstable is returned with its failure.
Run runScene(const scenes::Scene& scene);

}  // namespace studies
