// globular check: validates a scene and says what would run, what it would need, and how long it would take.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/bodies.h"
#include "engine/step_bound.h"
#include "engine/steppers.h"
#include "tools/commands.h"
#include "tools/scene_options.h"
#include "tools/threads.h"

namespace tools {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
    RunOptions run;
    SceneOptions scene;
};

/// Births that the schedules allow up to the last frame, if none has to wait.
std::uint64_t plannedBirths(const scenes::Scene& scene) {
    constexpr double kOnTime = 1e-9;  // as for the births themselves, s
    std::uint64_t sum = 0;
    for (const engine::Emitter& emitter : scene.setup.emitters) {
        const double lastFrame = scenes::frameTime(scene, scenes::frameCount(scene) - 1);
        // Due at `until` is too late, due at the last frame is not.
        const double end = std::min(lastFrame + kOnTime, emitter.until - 2.0 * kOnTime);
        if (end < emitter.start) continue;
        const double events = std::floor((end - emitter.start) / emitter.interval) + 1.0;
        const double schedules = emitter.pick == engine::Pick::all ? static_cast<double>(emitter.sites.size()) : 1.0;
        sum += static_cast<std::uint64_t>(std::min(static_cast<double>(emitter.limit), events * schedules));
    }
    return sum;
}

/// The particles at the start and one of each emitter: every kind that the run will have.
engine::Particles everyKind(const scenes::Scene& scene) {
    engine::Particles particles = scene.setup.initial;
    for (const engine::Emitter& emitter : scene.setup.emitters) {
        const engine::Material& material = scene.setup.materials[emitter.material];
        engine::append(particles, {.radius = material.radius, .mass = material.mass, .material = emitter.material});
    }
    return particles;
}

/// Bytes a particle takes while a frame is in flight: state, forces and prediction, sorted record and cells, spheres to
/// draw.
std::size_t bytesPerParticle() {
    const std::size_t state = 2 * sizeof(engine::Vec3) + 3 * sizeof(double) + 2 * sizeof(std::uint32_t);
    const std::size_t scratch = 2 * sizeof(engine::Vec3) + sizeof(engine::PairRecord) + 4 * sizeof(std::uint32_t);
    constexpr std::size_t kFramesInFlight = 4;
    return state + scratch + kFramesInFlight * sizeof(render::Sphere);
}

/// Seconds of one force evaluation per particle, measured on a packing at rest length of the scene's first material.
double secondsPerParticle(const scenes::Scene& scene, std::uint64_t particleCount) {
    constexpr std::uint64_t kLargest = 20000;  // chosen: some milliseconds
    const engine::Material& material = scene.setup.materials.front();
    const double spacing = 2.0 * material.radius;
    const double edge = spacing * std::cbrt(static_cast<double>(std::min(particleCount, kLargest)) / std::sqrt(2.0));
    engine::Particles particles;
    for (const engine::Vec3& position :
         engine::boxPositions(engine::Vec3::Zero(), engine::Vec3::Constant(edge), {.spacing = spacing}))
        engine::append(particles, {.position = position, .radius = material.radius, .mass = material.mass});
    engine::ForceEvaluator evaluator({scene.setup.materials, scene.setup.gravity, scene.setup.scenery},
                                     scene.setup.forces);
    std::vector<engine::Vec3> forces;
    double fastest = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round) {
        const auto start = std::chrono::steady_clock::now();
        evaluator.evaluate(particles, particles.velocity, forces);
        fastest = std::min(fastest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return fastest / static_cast<double>(particles.count());
}

Json boundJson(const scenes::Scene& scene) {
    const auto bound = engine::stepBound({scene.setup.materials, scene.setup.gravity, scene.setup.scenery},
                                         scene.setup.initial, scene.setup.stepper);
    if (!bound) return nullptr;
    return {{"seconds", bound->seconds},
            {"limited_by", bound->byDamping ? "damping" : "stiffness"},
            {"particle", bound->particle}};
}

Json checkJson(const scenes::Scene& scene) {
    const engine::ForceTerms terms =
        engine::termsFor({scene.setup.materials, scene.setup.gravity, scene.setup.scenery}, everyKind(scene));
    const std::uint64_t births = plannedBirths(scene);
    const std::uint64_t most = scene.setup.initial.count() + births;
    const int frames = scenes::frameCount(scene);
    const double stepsPerFrame = std::max(1.0, std::ceil(1.0 / scene.fps / scene.setup.step * (1.0 - 1e-9)));
    const double steps = stepsPerFrame * (frames - 1);
    // Births come evenly, so that half of them are there on average.
    const double meanParticles = static_cast<double>(scene.setup.initial.count()) + 0.5 * static_cast<double>(births);

    Json json;
    json["scene"] = scene.title;
    json["source"] = scene.sourceName;
    json["frames"] = frames;
    json["fps"] = scene.fps;
    json["particles_at_start"] = scene.setup.initial.count();
    json["particles_at_most"] = most;
    json["kernel"] = scene.setup.forces == engine::ForceMethod::grid ? "cell grid" : "every pair";
    json["terms"] = Json::array({"repulsion"});
    if (terms.pair.attraction) json["terms"].push_back("attraction");
    if (terms.pair.damping) json["terms"].push_back("damping");
    json["uniform"] = terms.uniform;
    json["cutoff"] = terms.cutoff;
    json["obstacles"] = scene.setup.scenery.colliders.size();
    json["stepper"] = engine::nameOf(scene.setup.stepper);
    json["step"] = 1.0 / scene.fps / stepsPerFrame;
    json["steps"] = static_cast<std::int64_t>(steps);
    json["step_bound_at_start"] = boundJson(scene);
    json["bytes_per_particle"] = bytesPerParticle();
    json["memory_bytes"] = most * bytesPerParticle();
    json["seconds_simulating"] = steps * meanParticles * secondsPerParticle(scene, most);
    return json;
}

std::string boundText(const Json& json) {
    const Json& bound = json["step_bound_at_start"];
    if (bound.is_null()) return "none: no two particles act on each other at the start (obstacles are not counted)";
    const double seconds = bound["seconds"].get<double>();
    const char* verdict = json["step"].get<double>() > seconds ? " -- the step is longer: expect instability" : "";
    return fmt::format("{:.4g} s for the pairs at the start, limited by the {} of particle {}{}", seconds,
                       bound["limited_by"].get<std::string>(), bound["particle"].get<std::size_t>(), verdict);
}

void printCheck(const Json& json) {
    fmt::print("{}: {}\n", json["source"].get<std::string>(), json["scene"].get<std::string>());
    fmt::print("frames     {} at {} a second\n", json["frames"].get<int>(), json["fps"].get<int>());
    fmt::print("particles  {} at the start, {} at most\n", json["particles_at_start"].get<std::uint64_t>(),
               json["particles_at_most"].get<std::uint64_t>());
    std::string terms;
    for (const Json& term : json["terms"]) terms += (terms.empty() ? "" : ", ") + term.get<std::string>();
    fmt::print("kernel     {}; {}; {}; cutoff {:.4g} m\n", json["kernel"].get<std::string>(), terms,
               json["uniform"].get<bool>() ? "one law and radius" : "law and radii looked up per pair",
               json["cutoff"].get<double>());
    fmt::print("obstacles  {}\n", json["obstacles"].get<std::size_t>());
    fmt::print("stepper    {}, {} steps of {:.4g} s\n", json["stepper"].get<std::string>(),
               json["steps"].get<std::int64_t>(), json["step"].get<double>());
    fmt::print("step bound {}\n", boundText(json));
    fmt::print("memory     {:.1f} MB, {} bytes a particle\n", json["memory_bytes"].get<double>() / 1e6,
               json["bytes_per_particle"].get<std::size_t>());
    fmt::print("time       about {:.0f} s of simulating on this machine, drawing not counted\n",
               std::ceil(json["seconds_simulating"].get<double>()));
}

void check(const CheckOptions& options) {
    const scenes::Scene scene = load(options.scene);
    Json json;
    onThreads(threadCount(options.run), [&] { json = checkJson(scene); });
    if (options.run.json)
        fmt::print("{}\n", json.dump());
    else if (!options.run.quiet)
        printCheck(json);
}

}  // namespace

void addCheckCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("check", "validate a scene and say what would run");
    const auto options = std::make_shared<CheckOptions>();
    addTo(*command, options->scene);
    addTo(*command, options->run);
    command->footer("Example: globular check my-scene.toml");
    command->callback([options] { check(*options); });
}

}  // namespace tools
