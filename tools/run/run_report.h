// run.json: what a run did, for people and scripts. Filled in by the loops of `render`, `simulate` and `figures`.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "engine/error_control/error_samples.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "scenes/model/scene.h"
#include "tools/frames/simulated_states.h"
#include "tools/system/json.h"

namespace tools {

/// Wall-clock seconds of a run by stage. Stages overlap, so that their sum may exceed the total.
struct StageSeconds {
    double simulating = 0.0;
    double reading = 0.0;   ///< reading states instead of simulating
    double drawing = 0.0;   ///< drawing pictures or making meshes
    double encoding = 0.0;  ///< encoding and writing PNG, PLY and video
    double all = 0.0;
};

/// Adds the wall-clock seconds of its lifetime to a sum.
class Stopwatch {
 public:
    explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;
    ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
    double& sum_;
    std::chrono::steady_clock::time_point start_;
};

/// Error samples as JSON, for a checkpoint.
Json encodeErrors(const engine::ErrorSamples& errors);
/// The error samples in the JSON of a checkpoint; no samples if the JSON is anything else.
engine::ErrorSamples decodeErrors(const Json& json);

/// What run.json, manifests and sidecars record of the renderer. A text is empty if there is nothing to record.
struct RendererRecord {
    std::string name;        ///< "cpu" or "opengl"
    std::string glRenderer;  ///< OpenGL's name of its renderer (GL_RENDERER)
    std::string glVersion;   ///< the version of OpenGL and of the driver (GL_VERSION)

    friend bool operator==(const RendererRecord&, const RendererRecord&) = default;
};

/// Adds the keys `renderer`, `gl_renderer` and `gl_version` to a JSON object, null where the text is empty.
void addTo(Json& json, const RendererRecord& renderer);

struct RunReport {
    StageSeconds seconds;
    engine::ErrorSamples errors;
    std::size_t largestCount = 0;  ///< largest number of particles in a state that was read; 0 if none was
    int frames = 0;                ///< number of frames asked for that were written or kept
    int threads = 1;
    RendererRecord renderer;  ///< what drew; empty if nothing was drawn
    Json depth;               ///< the scale of depth pictures; null if none were drawn
    Json mesh;                ///< what the meshes are of and what is in them; null if none were made
    std::string stateHash;    ///< hash of the particles at the last frame; empty if there is none
    std::string unstable;     ///< why the simulation became unstable; empty if it did not
    int interruptedBy = 0;    ///< the signal that ended the run early, or 0
    bool isCutShort = false;  ///< whether the signal ended the run at once: without frames in flight and final state
    std::optional<int> resumedFrom;  ///< the frame whose checkpoint the run resumed from
};

struct FinishedRun {
    engine::Simulation simulation;  ///< state at the last frame
    RunReport report;
    std::optional<engine::Energy> energy;  ///< at the last frame of a run that came to its end
    Json json;                             ///< the content of run.json; null for a run without a folder
};

/// A frame rate as JSON: a number, or a string if it is a fraction.
Json frameRateJson(const render::FrameRate& rate);

/// The parts of a scene that determine what its frames show. They are the first fields of run.json and part of the
/// identity in a folder's manifest.
Json sceneIdentity(const scenes::Scene& scene);

/// The content of run.json.
Json runJson(const scenes::Scene& scene, FinishedRun& run);

/// The content of run.json of a run that was drawn from states.
Json drawnRunJson(const scenes::Scene& scene, const RunReport& report, const SimulatedStates& states);

/// Throws if a run ended early.
/// @param folder  the folder of the run, for the message
/// @throws engine::InstabilityError if the simulation became unstable
/// @throws ExitStatus if a signal ended the run, with how to resume
void requireComplete(const RunReport& report, const std::string& folder);

}  // namespace tools
