// The fields of run.json.
#include "tools/run_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/diagnostics.h"
#include "engine/local_error.h"
#include "engine/steppers.h"
#include "render/metaball_cast.h"

namespace tools {
namespace {

using Json = nlohmann::ordered_json;

Json vectorJson(const engine::Vec3& vector) {
    return {vector.x(), vector.y(), vector.z()};
}

Json stepsJson(const engine::StepStatistics& steps) {
    return {{"count", steps.count},
            {"shortest", steps.shortest},
            {"longest", steps.longest},
            {"force_evaluations", steps.forceEvaluations},
            {"limited_by", "the scene's fixed step, shortened to divide a frame evenly"}};
}

Json errorJson(const ErrorSamples& errors) {
    if (errors.count == 0) return nullptr;
    return {{"position", errors.sum / errors.count},
            {"largest", errors.largest},
            {"unit", "radii per second of motion, rms over the particles"},
            {"obtained", "local error by step doubling, mean and largest over sampled frames"},
            {"samples", errors.count}};
}

Json energyJson(const engine::Energy& energy) {
    return {{"kinetic", energy.kinetic},
            {"pairs", energy.pairs},
            {"contacts", energy.contacts},
            {"gravity", energy.gravity},
            {"total", energy.total()}};
}

}  // namespace

void addSample(ErrorSamples& samples, const engine::Simulation& simulation) {
    if (simulation.steps.count == 0) return;
    const double error = engine::localError(simulation, simulation.steps.longest);
    ++samples.count;
    samples.sum += error;
    samples.largest = std::max(samples.largest, error);
}

Json runJson(const scenes::Scene& scene, engine::Simulation& simulation, const RunReport& report) {
    Json json;
    json["scene"] = scene.title;
    json["source"] = scene.sourceName;
    json["scene_hash"] = scene.sceneHash;
    json["version"] = GLOBULAR_VERSION;
    json["seed"] = scene.seed;
    json["threads"] = report.threads;
    json["instruction_set"] = render::castInstructionSet();
    json["gl_renderer"] = report.glRenderer.empty() ? Json(nullptr) : Json(report.glRenderer);
    json["particles"] = simulation.particles.count();
    json["births"] = engine::birthCount(simulation);
    json["refused_births"] = engine::refusalCount(simulation);
    json["frames"] = report.frames;
    json["fps"] = scene.fps;
    json["stepper"] = engine::nameOf(scene.setup.stepper);
    json["steps"] = stepsJson(simulation.steps);
    json["seconds"] = {{"simulating", report.seconds.simulating},
                       {"drawing", report.seconds.drawing},
                       {"encoding", report.seconds.encoding},
                       {"all", report.seconds.all}};
    json["error_estimate"] = errorJson(report.errors);
    if (report.unstable.empty()) {
        json["energy"] = energyJson(engine::energy(simulation.evaluator, simulation.particles));
        json["linear_momentum"] = vectorJson(engine::linearMomentum(simulation.particles));
        json["angular_momentum"] = vectorJson(engine::angularMomentum(simulation.particles));
    } else {
        json["unstable"] = report.unstable;
    }
    json["state_hash"] = report.stateHash;
    return json;
}

}  // namespace tools
