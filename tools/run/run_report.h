// run.json: what a run did, for people and scripts. Filled in by the loops that simulate and draw.
#pragma once

#include <optional>
#include <string>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"
#include "tools/system/json.h"

namespace tools {

/// Where a run's time went, s of wall clock; stages overlap, so they may add up to more than all.
struct StageSeconds {
    double simulating = 0.0;
    double drawing = 0.0;
    double encoding = 0.0;  ///< PNG, PLY and video
    double all = 0.0;
};

/// Errors of sampled frames, in radii per second of motion.
struct ErrorSamples {
    int count = 0;
    double sum = 0.0;
    double largest = 0.0;
};

/// As JSON, for a checkpoint, and back; none for JSON that is something else.
Json encodeErrors(const ErrorSamples& errors);
ErrorSamples decodeErrors(const Json& json);

/// Measures the error of the frame to come, at the step that the run takes, and adds it. Nothing for the automatic
/// stepper, which measures itself, and for a run that is about to become unstable.
void addSample(ErrorSamples& samples, const scenes::Scene& scene, const engine::Simulation& simulation);

struct RunReport {
    StageSeconds seconds;
    ErrorSamples errors;
    int frames = 0;  ///< of those asked for, written by this run or kept
    int threads = 1;
    std::string glRenderer;          ///< empty where nothing was drawn
    std::string stateHash;           ///< of the last frame; empty: there is none
    std::string unstable;            ///< why the run ended early; empty for a whole one
    int interruptedBy = 0;           ///< the signal that ended the run early, or 0
    std::optional<int> resumedFrom;  ///< the frame whose checkpoint the run went on from
};

/// What a run leaves behind besides its files.
struct FinishedRun {
    engine::Simulation simulation;  ///< at the last frame
    RunReport report;
};

/// What of a scene decides what its frames show: the first fields of run.json, and of a folder's manifest.
Json sceneIdentity(const scenes::Scene& scene);

/// Throws engine::InstabilityError or ExitStatus for a run that ended early, with what to do about it.
void requireComplete(const RunReport& report, const std::string& folder);

/// The content of run.json for a run that has come to the given state.
Json runJson(const scenes::Scene& scene, engine::Simulation& simulation, const RunReport& report);

}  // namespace tools
