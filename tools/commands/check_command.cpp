// globular check: validates a scene and predicts what would run, how much memory it would need, and how long it would
// take.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/error_control/step_cost.h"
#include "engine/force_law/compression.h"
#include "engine/neighbors/pair_estimate.h"
#include "engine/run/strays.h"
#include "engine/stepping/step_bound.h"
#include "engine/stepping/take_step.h"
#include "scenes/model/field_text.h"
#include "scenes/warnings/start_warnings.h"
#include "studies/scaling/rank_model.h"
#include "tools/commands/check_motions.h"
#include "tools/commands/commands.h"
#include "tools/run/forecast.h"
#include "tools/run/run_report.h"
#include "tools/run/run_warnings.h"
#include "tools/system/memory.h"
#include "tools/system/threads.h"
#include "tools/system/timed_child.h"

namespace tools {
namespace {

struct CheckOptions {
    RunOptions run;
    SceneOptions scene;
    int ranks = 0;  ///< of globular-mpi, for which a forecast is wanted; 0 if none is
};

/// Wall-clock time after which everything that needs more than the scene file is cut off, s. Chosen: with the time to
/// read a large scene, an answer comes within ten seconds.
constexpr unsigned kMostSeconds = 8;

/// Where the simulation of the first frames was cut off, as text; nothing if it was not.
Json cutOffJson(const Preview& preview) {
    if (!preview.isCutOff) return nullptr;
    return fmt::format("frame {} was not done after {:.0f} s and {} steps", preview.frames + 1, preview.seconds,
                       preview.stepsInCutOff);
}

/// What a whole run would take, extrapolated from its first frames: steps, stepper, error, time and memory. What takes
/// at least one frame to tell is null if the first one was cut off.
Json predictionJson(const scenes::Scene& scene, const Preview& preview) {
    const bool isWhole = preview.frames + 1 >= scenes::frameCount(scene) || !preview.unstable.empty();
    const std::optional<Preview> column = isWhole ? std::nullopt : simulateColumn(scene);
    const std::optional<Forecast> forecast = forecastOf(scene, preview, column);
    const double perFrame = static_cast<double>(preview.steps.count) / std::max(1, preview.frames);
    const bool isKnown = preview.frames > 0 || !preview.isCutOff;
    const auto ifKnown = [&](const auto& value) { return isKnown ? Json(value) : Json(nullptr); };
    const auto ifForecast = [&](double value) { return forecast ? Json(value) : Json(nullptr); };
    Json json;
    json["unstable"] = preview.unstable.empty() ? Json(nullptr) : Json(preview.unstable);
    json["cut_off"] = cutOffJson(preview);
    json["from_frames"] = preview.frames;
    json["stepper"] = engine::nameOf(preview.stepper);
    json["step"] = ifKnown(perFrame > 0.0 ? scene.fps.timeOf(1) / perFrame : 0.0);
    const auto& limits = preview.steps.limitedBy;
    json["limited_by"] = ifKnown(engine::nameOf(
        static_cast<engine::StepLimit>(std::max_element(limits.begin(), limits.end()) - limits.begin())));
    json["error"] = preview.automatic.intervalCount > 0
                        ? Json(preview.automatic.errorSum / static_cast<double>(preview.automatic.intervalCount))
                        : Json(nullptr);
    const Forecast found = forecast.value_or(Forecast{});
    json["steps"] = forecast ? Json(std::llround(found.steps)) : Json(nullptr);
    json["seconds_simulating"] = ifForecast(found.likelySeconds());
    json["seconds_least"] = ifForecast(found.leastSeconds);
    json["seconds_most"] = ifForecast(found.mostSeconds);
    json["processor_share"] = preview.seconds > 0.0 ? preview.processorSeconds / preview.seconds : 1.0;
    json["strays"] = engine::strayCount(preview.simulation);
    // A column gets further, to the twins of more steppers, which take most of the memory.
    json["bytes_per_particle"] = std::max(preview.bytesPerParticle, column ? column->bytesPerParticle : 0);
    json["bytes_of_materials"] = preview.bytesOfMaterials;
    return json;
}

Json boundJson(const scenes::Scene& scene, const std::string& stepperName) {
    engine::StepperKind stepper = scene.setup.stepper;
    for (const engine::StepperKind kind : engine::kSteppers)
        if (engine::nameOf(kind) == stepperName) stepper = kind;
    const auto bound = engine::stepBound(forceFieldOf(scene.setup), scene.setup.initial, stepper);
    if (!bound) return nullptr;
    return {{"seconds", bound->seconds},
            {"limited_by", bound->byDamping ? "damping" : "stiffness"},
            {"particle", bound->particle}};
}

/// The constants of a material, under the names of the keys of a scene file, and why mass, b1 and bd are what they are.
Json materialJson(const engine::Material& material, const std::string& note) {
    return {{"name", material.name},         {"b1", material.repulsion},        {"bd", material.damping},
            {"cr", material.repulsionReach}, {"cd", material.dampingReach},     {"radius", material.radius},
            {"mass", material.mass},         {"core", material.coreFraction},   {"friction", material.friction},
            {"cohesion", material.cohesion}, {"agitation", material.agitation}, {"note", note}};
}

/// Whether a material is a stage of one that melts; the scene file does not have it.
bool isBetween(const scenes::Scene& scene, std::size_t index) {
    return scene.setup.heat && std::ranges::any_of(scene.setup.heat->melts, [&](const engine::Melt& melt) {
               return index >= melt.first && index - melt.first < melt.count;
           });
}

/// What melts, and how often heat is exchanged; null in a scene without heat.
Json heatJson(const scenes::Scene& scene) {
    if (!scene.setup.heat) return nullptr;
    const engine::HeatSetup& heat = *scene.setup.heat;
    Json json = {{"interval", heat.interval}, {"melts", Json::array()}};
    for (const engine::Melt& melt : heat.melts) {
        const engine::Material& solid = scene.setup.materials[melt.solid];
        json["melts"].push_back({{"material", solid.name},
                                 {"from", solid.thermal.melting},
                                 {"to", solid.thermal.melting + solid.thermal.meltingRange},
                                 {"stages", melt.count}});
    }
    return json;
}

/// The lines on heat; none in a scene without.
std::string heatText(const Json& heat) {
    if (heat.is_null()) return {};
    std::string text = fmt::format("heat       exchanged every {:.3g} s\n", heat["interval"].get<double>());
    for (const Json& melt : heat["melts"])
        text +=
            fmt::format("           {} melts from {:g} to {:g} K, in {} stages\n", melt["material"].get<std::string>(),
                        melt["from"].get<double>(), melt["to"].get<double>(), melt["stages"].get<int>());
    return text;
}

/// How tall a body is, and to what share of that it sinks under its own weight; null where nothing weighs on it. That
/// share is null where the body draws itself together.
Json bodyJson(const scenes::BodyColumn& body) {
    if (body.shape.height == 0.0) return nullptr;
    Json json = {{"height", body.shape.height}, {"sinks_to", nullptr}};
    if (!engine::drawsTogether(body.material, body.shape))
        json["sinks_to"] = engine::settledShare(body.material, body.shape);
    return json;
}

/// What blurs the pictures of final quality; null if nothing does.
Json blurJson(const scenes::Scene& scene) {
    double shutter = 0.0;
    double aperture = 0.0;
    for (const scenes::CameraKey& key : scene.camera) {
        shutter = std::max(shutter, key.placement.shutter);
        aperture = std::max(aperture, key.placement.aperture);
    }
    if (shutter == 0.0 && aperture == 0.0) return nullptr;
    const int perAxis = scene.look.common.samplesPerAxis;
    return {{"shutter", shutter}, {"aperture", aperture}, {"samples", perAxis * perAxis}};
}

/// What follows from the scene file alone.
Json sceneJson(const scenes::Scene& scene) {
    const engine::ForceTerms terms = engine::termsFor(forceFieldOf(scene.setup), everyKind(scene));
    Json json;
    json["scene"] = scene.title;
    json["source"] = scene.sourceName;
    json["frames"] = scenes::frameCount(scene);
    json["fps"] = frameRateJson(scene.fps);
    json["particles_at_start"] = scene.setup.initial.count();
    json["particles_at_most"] = scene.setup.initial.count() + plannedBirths(scene);
    json["kernel"] = scene.setup.forces == engine::ForceMethod::grid ? "cell grid" : "every pair";
    json["terms"] = Json::array({"repulsion"});
    if (terms.pair.attraction) json["terms"].push_back("attraction");
    if (terms.pair.damping) json["terms"].push_back("damping");
    if (terms.pair.friction) json["terms"].push_back("friction");
    if (terms.pair.cohesion) json["terms"].push_back("cohesion");
    json["materials"] = Json::array();
    for (std::size_t index = 0; index < scene.setup.materials.size(); ++index)
        if (!isBetween(scene, index))
            json["materials"].push_back(materialJson(scene.setup.materials[index], scene.materialNotes[index]));
    json["heat"] = heatJson(scene);
    json["agitation_interval"] = scene.setup.agitationInterval;
    json["bodies"] = Json::array();
    for (const scenes::BodyColumn& body : scene.bodyColumns) json["bodies"].push_back(bodyJson(body));
    json["meshes"] = scene.meshNotes;
    json["uniform"] = terms.uniform();
    json["cutoff"] = terms.cutoff;
    json["obstacles"] = scene.setup.obstacles.shapes.size();
    json["motions"] = motionsJson(scene);
    json["fields"] = Json::array();
    for (const engine::Field& field : scene.setup.fields) json["fields"].push_back(scenes::fieldText(field));
    json["blur"] = blurJson(scene);
    json["stepper"] = engine::nameOf(scene.setup.stepper);
    json["wanted_error"] =
        scene.setup.stepper == engine::StepperKind::automatic ? Json(scene.setup.error) : Json(nullptr);
    return json;
}

/// Why the first frames are not simulated: because the list of neighbors would not fit into memory. Nothing if it fits.
std::optional<std::string> crowdingText(const scenes::Scene& scene) {
    constexpr double kBytesPerPair = 8.0;  // an entry of 4 bytes in the rows of both particles
    const engine::Particles& particles = scene.setup.initial;
    if (scene.setup.forces == engine::ForceMethod::reference) return std::nullopt;
    const double pairs = engine::estimatePairCount(particles.position, particles.radius,
                                                   engine::termsFor(forceFieldOf(scene.setup), particles).cutoff);
    const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
    if (kBytesPerPair * pairs < memory) return std::nullopt;
    return fmt::format(
        "the particles have {:.2g} neighbors on average at the start, and a list of them takes {:.2g} GB of memory; "
        "this "
        "machine has {:.2g}",
        2.0 * pairs / static_cast<double>(particles.count()), kBytesPerPair * pairs / 1e9, memory / 1e9);
}

/// The memory that this process has in use, in bytes; 0 where the system does not tell.
std::uint64_t residentBytes() {
    std::ifstream stream("/proc/self/statm");
    std::uint64_t all = 0;
    std::uint64_t resident = 0;
    stream >> all >> resident;
    return resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// What a step of the scene would take on some ranks of globular-mpi, as far as the model tells.
Json ranksJson(const scenes::Scene& scene, const Preview& preview, int ranks) {
    const engine::Particles& particles = preview.simulation.particles;
    const double steps = engine::forceEvaluationsOf(preview.simulation) + preview.automatic.estimateCost;
    if (particles.count() == 0 || !(steps > 0.0)) return nullptr;
    const double cutoff = engine::termsFor(forceFieldOf(scene.setup), particles).cutoff;
    const auto count = static_cast<double>(particles.count());
    const double pairs = engine::estimatePairCount(particles.position, particles.radius, cutoff);
    const studies::StepOnRanks step =
        studies::stepOnRanks({count, 2.0 * pairs / count, preview.processorSeconds / steps}, ranks);
    return {{"count", ranks},
            {"particles", std::llround(step.particles)},
            {"ghosts", std::llround(step.ghosts)},
            {"speedup", ranks * step.efficiency},
            {"efficiency", step.efficiency}};
}

/// Looks at the start of the scene, simulates its first frames and draws the last of them, and reports one result after
/// the other.
/// @param isStrict  whether the scene is not simulated if there are warnings
/// @param ranks     number of ranks for which a forecast is wanted, or 0
void examine(const scenes::Scene& scene, bool isStrict, int ranks, const Report& report) {
    std::vector<std::string> warnings = scenes::startWarnings(scene);
    report({{"warnings", warnings}});
    if (isStrict && !(warnings.empty() && scene.warnings.empty())) return;
    if (const auto crowding = crowdingText(scene)) return report({{"cut_off", *crowding}});
    const Preview preview = simulateBeginning(scene);
    const Json predicted = predictionJson(scene, preview);
    report({{"predicted", predicted}});
    if (ranks > 0) report({{"ranks", ranksJson(scene, preview, ranks)}});
    if (const Json& error = predicted["error"]; !error.is_null() && isErrorMissed(error, scene.setup.error)) {
        warnings.push_back(scenes::missedErrorWarning(scene, error));
        report({{"warnings", warnings}});
    }
    report({{"step_bound_at_start", boundJson(scene, predicted["stepper"].get<std::string>())}});
    const bool isDrawn = preview.unstable.empty();
    report({{"seconds_drawing", isDrawn ? Json(secondsOfDrawing(scene, preview.simulation)) : Json(nullptr)}});
}

/// Everything that `check` says. What was not found out when the time was up is missing, and "cut_off" says what took
/// so long.
Json checkJson(const scenes::Scene& scene, const CheckOptions& options) {
    const int threads = threadCount(options.run);
    const std::uint64_t bytesOfProgram = residentBytes();
    // The child comes first, because it must not be started after other threads.
    const Json found = runInChild(kMostSeconds, [&](const Report& report) {
        withMemoryForParticles(scene.setup.initial.count(), [&] {
            onThreads(threads, [&] { examine(scene, options.scene.isStrict, options.ranks, report); });
        });
    });
    Json json;
    onThreads(threads, [&] { json = sceneJson(scene); });
    json.update(found);
    if (found.contains("cut_off")) return json;
    const char* const slow = !found.contains("warnings")              ? "looking at where the particles start"
                             : !found.contains("predicted")           ? "the first time step"
                             : !found.contains("step_bound_at_start") ? "finding the step bound"
                             : !found.contains("seconds_drawing")     ? "drawing a frame"
                                                                      : nullptr;
    json["cut_off"] =
        slow == nullptr ? Json(nullptr) : Json(fmt::format("{} takes more than {} s", slow, kMostSeconds));
    if (!found.contains("predicted")) return json;
    const Json& predicted = json["predicted"];
    if (slow == nullptr) json["cut_off"] = predicted["cut_off"];
    json["bytes_per_particle"] = predicted["bytes_per_particle"];
    json["memory_bytes"] =
        json["particles_at_most"].get<std::uint64_t>() * predicted["bytes_per_particle"].get<std::uint64_t>() +
        predicted["bytes_of_materials"].get<std::uint64_t>() + bytesOfProgram;
    return json;
}

std::string boundText(const Json& json) {
    const Json& bound = json["step_bound_at_start"];
    if (bound.is_null()) return "none: no two particles act on each other at the start (obstacles are not counted)";
    const double seconds = bound["seconds"].get<double>();
    const Json& step = json["predicted"]["step"];
    const bool isLonger = !step.is_null() && step.get<double>() > seconds;
    const bool rescued = json["stepper"].get<std::string>() != "symplectic-euler";
    const char* verdict = !isLonger ? ""
                          : rescued ? " -- the step is longer: expect steps that are taken back"
                                    : " -- the step is longer: expect instability";
    return fmt::format("{:.4g} s for the pairs at the start, limited by the {} of particle {}{}", seconds,
                       bound["limited_by"].get<std::string>(), bound["particle"].get<std::size_t>(), verdict);
}

/// The time of drawing, which may pass while the next frames are simulated; empty if it was not found out.
std::string drawingText(const Json& json) {
    const Json seconds = json.value("seconds_drawing", Json(nullptr));
    if (seconds.is_null()) return "";
    return fmt::format(" and {} of drawing", durationText(seconds.get<double>(), seconds.get<double>()));
}

/// The lines on what was found out by simulating the first frames, as far as it was found out.
std::string predictedText(const Json& json) {
    std::string text = "stepper    " + json["stepper"].get<std::string>();
    if (!json.contains("predicted")) return text + "\n";
    const Json& predicted = json["predicted"];
    if (!predicted["unstable"].is_null())
        text += fmt::format("; unstable after {} frames", predicted["from_frames"].get<int>());
    else if (!predicted["step"].is_null())
        text += fmt::format("; from the first {} frames: {}, {} steps of about {:.4g} s, limited by the {}",
                            predicted["from_frames"].get<int>(), predicted["stepper"].get<std::string>(),
                            predicted["steps"].get<std::int64_t>(), predicted["step"].get<double>(),
                            predicted["limited_by"].get<std::string>());
    text += "\n";
    if (!predicted["error"].is_null())
        text += fmt::format("error      {:.2g} radii a second wanted, {:.2g} measured so far\n",
                            json["wanted_error"].get<double>(), predicted["error"].get<double>());
    if (const auto strays = predicted["strays"].get<std::uint64_t>(); strays > 0)
        text += fmt::format("warning    {}\n", strayWarning(strays));
    if (json.contains("step_bound_at_start")) text += fmt::format("step bound {}\n", boundText(json));
    text += fmt::format("memory     at most {:.1f} MB, {} bytes a particle\n", json["memory_bytes"].get<double>() / 1e6,
                        json["bytes_per_particle"].get<std::size_t>());
    if (predicted["unstable"].is_null() && !predicted["seconds_simulating"].is_null())
        text +=
            fmt::format("time       {} of simulating{} on this machine\n",
                        durationText(predicted["seconds_least"].get<double>(), predicted["seconds_most"].get<double>()),
                        drawingText(json));
    else if (predicted["unstable"].is_null())
        text += "time       not known: not even the first frame was done\n";
    return text;
}

/// The line on ranks: how fast steps are on them, and how well they are used; empty without --ranks.
std::string ranksText(const Json& json) {
    const Json ranks = json.value("ranks", Json(nullptr));
    if (ranks.is_null()) return "";
    constexpr double kWorthwhile = 0.5;  // efficiency from which ranks are said to pay; chosen
    const double efficiency = ranks["efficiency"].get<double>();
    return fmt::format(
        "ranks      {}: {} particles and {} ghosts each; steps {:.3g} times as fast as on one thread: {}\n",
        ranks["count"].get<int>(), ranks["particles"].get<std::int64_t>(), ranks["ghosts"].get<std::int64_t>(),
        ranks["speedup"].get<double>(),
        efficiency >= kWorthwhile
            ? fmt::format("{:.0f} % of each is used", 100.0 * efficiency)
            : fmt::format("only {:.0f} % of each is used, fewer ranks or threads pay better", 100.0 * efficiency));
}

/// A line for each body that gravity compresses, up to as many as one reads.
std::string bodiesText(const Json& bodies) {
    constexpr std::size_t kMostLines = 12;  // chosen
    std::string text;
    for (std::size_t index = 0; index < bodies.size(); ++index) {
        if (bodies[index].is_null()) continue;
        if (index >= kMostLines) return text + fmt::format("body       ... {} in all\n", bodies.size());
        const Json& share = bodies[index]["sinks_to"];
        text += fmt::format("body       {}: ", index + 1);
        if (share.is_null())
            text += "draws itself together, so that it does not follow how far it sinks\n";
        else
            text += fmt::format("a column as tall as it, {:.3g} m, sinks to {:.2g} of its height by its own weight\n",
                                bodies[index]["height"].get<double>(), share.get<double>());
    }
    return text;
}

/// What `check` prints without --json.
std::string checkText(const Json& json) {
    std::string text = fmt::format("{}: {}\n", json["source"].get<std::string>(), json["scene"].get<std::string>());
    text += fmt::format("frames     {} at {} a second\n", json["frames"].get<int>(),
                        json["fps"].is_string() ? json["fps"].get<std::string>() : compactText(json["fps"]));
    text += fmt::format("particles  {} at the start, {} at most\n", json["particles_at_start"].get<std::uint64_t>(),
                        json["particles_at_most"].get<std::uint64_t>());
    std::string terms;
    for (const Json& term : json["terms"]) terms += (terms.empty() ? "" : ", ") + term.get<std::string>();
    text += fmt::format("kernel     {}; {}; {}; cutoff {:.4g} m\n", json["kernel"].get<std::string>(), terms,
                        json["uniform"].get<bool>() ? "one field and radius" : "law and radii looked up per pair",
                        json["cutoff"].get<double>());
    for (const Json& material : json["materials"]) {
        const auto value = [&](const char* key) { return material[key].get<double>(); };
        text += fmt::format(
            "material   {}: b1 {:g}, bd {:g}, cr {:g}, cd {:g}, radius {:g} m, mass {:g} kg, core {:g}, friction "
            "{:g}\n",
            material["name"].get<std::string>(), value("b1"), value("bd"), value("cr"), value("cd"), value("radius"),
            value("mass"), value("core"), value("friction"));
        if (const auto note = material["note"].get<std::string>(); !note.empty())
            text += fmt::format("           {}\n", note);
    }
    text += heatText(json["heat"]);
    if (const double interval = json["agitation_interval"].get<double>(); interval > 0.0)
        text += fmt::format("agitation  random impulses every {:.3g} s\n", interval);
    text += bodiesText(json["bodies"]);
    for (const Json& mesh : json["meshes"]) text += fmt::format("mesh       {}\n", mesh.get<std::string>());
    text += fmt::format("obstacles  {}\n", json["obstacles"].get<std::size_t>());
    text += motionsText(json["motions"]);
    for (const Json& field : json["fields"]) text += fmt::format("field      {}\n", field.get<std::string>());
    if (const Json& blur = json["blur"]; !blur.is_null())
        text += fmt::format("blur       shutter {:g}, aperture {:g} m; with --quality final only, {} samples a pixel\n",
                            blur["shutter"].get<double>(), blur["aperture"].get<double>(), blur["samples"].get<int>());
    text += predictedText(json);
    text += ranksText(json);
    if (const Json& cutOff = json["cut_off"]; !cutOff.is_null())
        text += fmt::format("cut off    {}\n", cutOff.get<std::string>());
    for (const Json& warning : json.value("warnings", Json::array()))
        text += fmt::format("warning    {}\n", warning.get<std::string>());
    return text;
}

void check(const CheckOptions& options) {
    const scenes::Scene scene = load(options.scene);
    const Json json = checkJson(scene, options);
    if (options.scene.isStrict) {
        std::vector<std::string> warnings = scene.warnings;
        for (const Json& warning : json.value("warnings", Json::array())) warnings.push_back(warning);
        refuse(warnings);
    }
    printResult(options.run, json, checkText(json));
    const Json unstable = json.value("/predicted/unstable"_json_pointer, Json(nullptr));
    if (!unstable.is_null()) throw engine::InstabilityError(unstable.get<std::string>());
}

}  // namespace

void addCheckCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("check", "validate a scene and say what would run");
    const auto options = std::make_shared<CheckOptions>();
    addTo(command, options->scene);
    addStrictFlag(command, options->scene);
    command
        .add_option("--ranks", options->ranks,
                    "also say what so many ranks of globular-mpi would gain (docs/beyond-one-machine.md)")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    addTo(command, options->run);
    command.footer(
        "Simulates the first frames of the scene. What is not found out within about ten seconds is cut off.\n"
        "Example: globular check my-scene.toml");
    command.callback([options] { check(*options); });
}

}  // namespace tools
