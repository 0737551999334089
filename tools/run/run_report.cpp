// Collects the fields of run.json.
#include "tools/run/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "engine/error_control/twin.h"
#include "engine/forces/simd_forces.h"
#include "engine/run/diagnostics.h"
#include "engine/run/strays.h"
#include "engine/stepping/take_step.h"
#include "render/picture/system_error.h"
#include "tools/loads/load_table.h"
#include "tools/run/emission_report.h"
#include "tools/run/run_warnings.h"
#include "tools/system/json.h"
#include "tools/system/process.h"

namespace tools {
namespace {

/// A larger number of error samples in a checkpoint is rejected: no run has as many frames.
constexpr int kMostSamples = 1 << 30;

Json vectorJson(const engine::Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

/// A JSON object with the counts that are not zero, each under its name, the largest first.
template <class Names, std::size_t size>
Json countsJson(const std::array<std::uint64_t, size>& counts, const Names& nameOfIndex) {
    std::vector<std::size_t> indices;
    for (std::size_t index = 0; index < size; ++index)
        if (counts[index] > 0) indices.push_back(index);
    std::stable_sort(indices.begin(), indices.end(), [&](auto a, auto b) { return counts[a] > counts[b]; });
    Json json = Json::object();
    for (const std::size_t index : indices) json[std::string(nameOfIndex(index))] = counts[index];
    return json;
}

/// @param estimateCost  of the error estimates, which the statistics do not have, in force evaluations
Json stepsJson(const engine::StepStatistics& steps, double estimateCost) {
    const auto ofEstimates = static_cast<std::uint64_t>(std::llround(estimateCost));
    return {{"count", steps.count},
            {"shortest", steps.shortest},
            {"longest", steps.longest},
            {"limited_by", countsJson(steps.limitedBy,
                                      [](std::size_t i) { return engine::nameOf(static_cast<engine::StepLimit>(i)); })},
            {"taken_by", countsJson(steps.takenBy,
                                    [](std::size_t i) { return engine::nameOf(static_cast<engine::StepperKind>(i)); })},
            {"rejected", steps.rejected},
            {"force_evaluations", steps.forceEvaluations + ofEstimates},
            {"force_evaluations_of_error_estimates", ofEstimates},
            {"matrices", steps.matrices},
            {"matrix_products", steps.products}};
}

/// The error estimates of the automatic stepper, or else those sampled by the run.
engine::ErrorSamples errorsOf(const engine::Simulation& simulation, const engine::ErrorSamples& samples) {
    if (simulation.setup.stepper != engine::StepperKind::automatic) return samples;
    const engine::AutoState& state = simulation.automatic;
    return {static_cast<int>(state.intervalCount), state.errorSum, state.largestError, state.estimateCost};
}

Json errorJson(const engine::Simulation& simulation, const engine::ErrorSamples& samples) {
    const engine::ErrorSamples errors = errorsOf(simulation, samples);
    if (errors.count == 0) return nullptr;
    Json json = {{"position", errors.sum / errors.count},
                 {"largest", errors.largest},
                 {"unit", "radii per second of motion, rms over the particles"},
                 {"obtained", "parts of frames run again at half the step: mean and largest over the samples"},
                 {"samples", errors.count},
                 {"force_evaluations_spent", errors.evaluationCost}};
    if (simulation.setup.stepper == engine::StepperKind::automatic) {
        json["obtained"] = fmt::format(
            "every step's own estimate, calibrated by trial runs of {} s with longer steps: mean and largest over the "
            "frames",
            engine::kTwinSeconds);
        json["wanted"] = simulation.setup.error;
    }
    return json;
}

Json energyJson(const engine::Energy& energy) {
    Json json = {{"kinetic", energy.kinetic},
                 {"pairs", energy.pairs},
                 {"contacts", energy.contacts},
                 {"gravity", energy.gravity},
                 {"total", energy.total()}};
    if (energy.fields != 0.0) json["fields"] = energy.fields;
    return json;
}

/// Where the heat of the particles came from and went to, J.
Json heatJson(const engine::HeatState& heat) {
    return {{"exchanges", heat.exchangeCount},
            {"received", heat.received},
            {"from_motion", heat.damped},
            {"paid_for_melting", heat.ofMelting},
            {"pending", heat.pending}};
}

/// The first fields of run.json: the scene, and what the program ran on and drew with.
Json programJson(const scenes::Scene& scene, const RunReport& report) {
    Json json = sceneIdentity(scene);
    json["source"] = scene.sourceName;
    json["threads"] = report.threads;
    json["instruction_set"] = engine::simdInstructionSet();
    addTo(json, report.renderer);
    if (!report.depth.is_null()) json["depth"] = report.depth;
    if (!report.mesh.is_null()) json["mesh"] = report.mesh;
    return json;
}

}  // namespace

Json encodeErrors(const engine::ErrorSamples& errors) {
    return {{"count", errors.count},
            {"sum", errors.sum},
            {"largest", errors.largest},
            {"evaluation_cost", errors.evaluationCost}};
}

engine::ErrorSamples decodeErrors(const Json& json) {
    const auto isNumber = [&](const char* key) { return json.contains(key) && json[key].is_number(); };
    if (!isNumber("count") || !json["count"].is_number_integer() || !isNumber("sum") || !isNumber("largest") ||
        !isNumber("evaluation_cost"))
        return {};
    const auto count = json["count"].get<std::int64_t>();
    if (count < 0 || count > kMostSamples) return {};
    return {static_cast<int>(count), json["sum"].get<double>(), json["largest"].get<double>(),
            json["evaluation_cost"].get<double>()};
}

void addTo(Json& json, const RendererRecord& renderer) {
    const auto textOrNull = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
    json["renderer"] = textOrNull(renderer.name);
    json["gl_renderer"] = textOrNull(renderer.glRenderer);
    json["gl_version"] = textOrNull(renderer.glVersion);
}

Json frameRateJson(const render::FrameRate& rate) {
    return rate.denominator == 1 ? Json(rate.numerator) : Json(rate.text());
}

Json sceneIdentity(const scenes::Scene& scene) {
    return {{"scene", scene.title},        {"scene_hash", scene.sceneHash}, {"simulation_hash", scene.simulationHash},
            {"version", GLOBULAR_VERSION}, {"seed", scene.setup.seed},      {"fps", frameRateJson(scene.fps)}};
}

Json runJson(const scenes::Scene& scene, FinishedRun& run) {
    engine::Simulation& simulation = run.simulation;
    const RunReport& report = run.report;
    Json json = programJson(scene, report);
    json["particles"] = engine::largestCount(simulation);
    json["births"] = engine::birthCount(simulation);
    json["refused_births"] = engine::refusalCount(simulation);
    json["emitters"] = emittersJson(simulation);
    json["deaths"] = simulation.removedCount;
    json["troubles"] = troublesOf(scene, simulation);
    json["strays"] = engine::strayCount(simulation);
    json["walls"] = {{"held", simulation.steps.held},
                     {"deepest", simulation.wallDepths.deepest},
                     {"centers_outside", simulation.wallDepths.centersOutside}};
    if (!simulation.loads.empty()) json["obstacles"] = loadsJson(scene, simulation);
    if (simulation.setup.agitationInterval > 0.0)
        json["agitation"] = {{"count", simulation.agitation.count}, {"work", simulation.agitation.work}};
    if (simulation.setup.heat) json["heat"] = heatJson(simulation.heat);
    json["frames"] = report.frames;
    json["resumed_from"] = report.resumedFrom ? Json(*report.resumedFrom) : Json(nullptr);
    json["interrupted"] = report.interruptedBy != 0;
    json["stepper"] = engine::nameOf(scene.setup.stepper);
    json["steps"] = stepsJson(simulation.steps, errorsOf(simulation, report.errors).evaluationCost);
    json["seconds"] = {{"simulating", report.seconds.simulating},
                       {"drawing", report.seconds.drawing},
                       {"encoding", report.seconds.encoding},
                       {"all", report.seconds.all}};
    json["error_estimate"] = errorJson(simulation, report.errors);
    if (run.energy) {
        json["energy"] = energyJson(*run.energy);
        json["linear_momentum"] = vectorJson(engine::linearMomentum(simulation.particles));
        json["angular_momentum"] = vectorJson(engine::angularMomentum(simulation.particles));
    } else if (!report.unstable.empty()) {
        json["unstable"] = report.unstable;
    }
    json["state_hash"] = report.stateHash;
    return json;
}

Json drawnRunJson(const scenes::Scene& scene, const RunReport& report, const SimulatedStates& states) {
    Json json = programJson(scene, report);
    json["drawn_from"] = {{"states", states.path().string()}, {"version", states.version()}};
    json["particles"] = report.largestCount;
    json["frames"] = report.frames;
    json["interrupted"] = report.interruptedBy != 0;
    json["seconds"] = {{"reading", report.seconds.reading},
                       {"drawing", report.seconds.drawing},
                       {"encoding", report.seconds.encoding},
                       {"all", report.seconds.all}};
    json["state_hash"] = report.stateHash;
    return json;
}

void requireComplete(const RunReport& report, const std::string& folder) {
    if (!report.unstable.empty()) throw engine::InstabilityError(report.unstable);
    if (report.interruptedBy == 0) return;
    throw ExitStatus(kSignalExitBase + report.interruptedBy,
                     fmt::format("interrupted after {} frames, which are whole in {}; to go on, give the same command "
                                 "with --resume (and without --overwrite)",
                                 report.frames, folder));
}

}  // namespace tools
