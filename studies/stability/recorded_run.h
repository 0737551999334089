// Runs a scene and keeps the particles at every frame, from which the study of stability computes its observables.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// Why a run ended before the scene did.
struct Failure {
    double time = 0.0;  ///< scene time of the failure, s
    std::string message;
};

/// A run of a scene, with all of its frames.
struct Run {
    std::vector<engine::Particles> frames;  ///< particles at every frame, from frame 0 to the end or to a failure
    std::vector<std::uint64_t> stepsUntil;  ///< number of steps taken until each frame
    engine::Simulation end;                 ///< the simulation at the end of the run
    double seconds = 0.0;                   ///< wall-clock time of the run
    std::optional<Failure> failure;
};

/// Runs a scene with its own stepper from frame 0 to the frame at its duration, that frame included. World bounds are
/// ignored, because observables follow every particle. A run that becomes unstable is returned with its failure.
Run runScene(const scenes::Scene& scene);

}  // namespace studies
