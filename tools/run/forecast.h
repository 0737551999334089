// What a run of a scene would do, found out without running it to the end. Used by `check`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"

namespace tools {

/// How many particles the emitters are scheduled to emit up to the last frame, if none of them has to wait for room.
std::uint64_t plannedBirths(const scenes::Scene& scene);

/// The particles at the start and one of each emitter: every kind of particle that the run will have.
engine::Particles everyKind(const scenes::Scene& scene);

/// How the first frames of a run went.
struct Preview {
    engine::Simulation simulation;    ///< state at the last frame that was simulated; somewhere beyond it if `isCutOff`
    std::string unstable;             ///< why the simulation became unstable; empty if it did not
    int frames = 0;                   ///< how many frames were simulated
    bool isCutOff = false;            ///< whether the time was up before the end of the next frame
    std::uint64_t stepsInCutOff = 0;  ///< number of steps tried in that frame, those of error estimates included
    double seconds = 0.0;             ///< wall-clock time of the simulation, with births and error estimates
    double particleFrames = 0.0;      ///< sum over the frames of the number of particles
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;  ///< stepper in use at the last frame
    engine::StepStatistics steps;                                       ///< steps up to the last frame
    engine::AutoState automatic;                                        ///< automatic stepper at the last frame
    std::size_t mostParticles = 0;                                      ///< largest number of particles at any frame
    /// Memory per particle of a simulation whose frames are drawn at the same time, in bytes, measured when there were
    /// most particles; 0 if there were none.
    std::size_t bytesPerParticle = 0;
    std::size_t bytesOfMaterials = 0;  ///< memory that does not depend on the number of particles, in bytes
};

/// Simulates the first frames of a scene, for about two seconds.
/// @param mostSeconds  wall-clock time after which a frame is cut off, at the end of a step
Preview simulateBeginning(const scenes::Scene& scene, double mostSeconds = 5.0);

}  // namespace tools
