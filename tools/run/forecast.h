// What a run of a scene would do, found out without running it to the end. Used by `check`.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/state/simulation.h"
#include "scenes/model/scene.h"

namespace tools {

/// How many particles the emitters are scheduled to emit up to a time (s), if none of them has to wait for room.
std::uint64_t plannedBirths(const scenes::Scene& scene, double time);
/// The same up to the last frame.
std::uint64_t plannedBirths(const scenes::Scene& scene);

/// The particles at the start and one of each emitter: every kind of particle that the run will have.
engine::Particles everyKind(const scenes::Scene& scene);

/// What a frame took to simulate.
struct FrameWork {
    double evaluations = 0.0;  ///< cost of its steps, in force evaluations
    double estimates = 0.0;    ///< cost of the automatic stepper's error estimates, in force evaluations
    double particles = 0.0;    ///< number of particles at its end
};

/// How the first frames of a run went.
struct Preview {
    engine::Simulation simulation;    ///< state at the last frame that was simulated; somewhere beyond it if `isCutOff`
    std::string unstable;             ///< why the simulation became unstable; empty if it did not
    int frames = 0;                   ///< how many frames were simulated
    bool isCutOff = false;            ///< whether the time was up before the end of the next frame
    std::uint64_t stepsInCutOff = 0;  ///< number of steps tried in that frame, those of error estimates included
    double seconds = 0.0;             ///< wall-clock time of the simulation, with births and error estimates
    double secondsOfFrames = 0.0;     ///< the same up to the last frame, without the one that was cut off
    double processorSeconds = 0.0;    ///< `seconds` in processor time of all threads
    std::vector<FrameWork> work;      ///< what each frame took
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
Preview simulateBeginning(const scenes::Scene& scene, double mostSeconds = 4.0);

/// Simulates a column of a large scene, a few thousand of the particles that it starts with, which gets much further in
/// about two seconds than all of the scene: its frames need about as many steps. Nothing for a scene that is hardly
/// larger than that.
std::optional<Preview> simulateColumn(const scenes::Scene& scene);

/// How long a run takes to simulate on this machine. The true time is likely to be between the least and the most.
struct Forecast {
    double leastSeconds = 0.0;  ///< wall-clock time
    double mostSeconds = 0.0;   ///< wall-clock time; equal to the least if all frames were simulated
    double steps = 0.0;         ///< number of steps, likely
    double particles = 0.0;     ///< number of particles at the last frame, as far as emitters have found room so far

    double likelySeconds() const { return std::sqrt(leastSeconds * mostSeconds); }
};

/// What the previews of a scene tell about the whole run; nothing if they tell too little, because not even the first
/// frame was done.
std::optional<Forecast> forecastOf(const scenes::Scene& scene, const Preview& beginning,
                                   const std::optional<Preview>& column);

/// Wall-clock time in which all frames of a scene are drawn in normal quality and encoded, s, if each takes as long as
/// the one that shows this state.
double secondsOfDrawing(const scenes::Scene& scene, const engine::Simulation& simulation);

/// A range of time in words: "about 12 s", "3 to 9 minutes". It is "about" where the ends are no further than a factor
/// of 2 apart, so that the middle is within a factor of 1.5 of both.
std::string durationText(double leastSeconds, double mostSeconds);

}  // namespace tools
