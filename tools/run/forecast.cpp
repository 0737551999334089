// Counts the births on the emitters' schedules, runs the first frames, and extrapolates from them. Work is counted in
// force evaluations times particles, which take about the same time everywhere in a scene.
#include "tools/run/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "engine/error_control/step_cost.h"
#include "engine/run/run_memory.h"
#include "engine/stepping/take_step.h"
#include "render/output/png.h"
#include "render/picture/view.h"
#include "scenes/view/frame_view.h"
#include "tools/run/open_renderer.h"
#include "tools/run/run_report.h"

namespace tools {
namespace {

using engine::Vec3;

/// Wall-clock times for the first frames and for those of a column, and after which a frame of a column is cut off, s.
/// Chosen: with the rest of `check`, an answer comes within ten seconds.
constexpr double kSecondsEnough = 2.5;
constexpr double kColumnSeconds = 2.0;
constexpr double kMostColumnSeconds = 2.5;

/// Number of particles of a column. Chosen: as many as run some hundred force evaluations a second on any machine, and
/// enough for some dozen across a column as tall as a dam.
constexpr std::size_t kColumnCount = 2000;

/// Error estimates of the automatic stepper over its steps, as long as few frames are known. Chosen: the mean of the
/// built-in scenes; and no more than as much, because the pause after an estimate costs as much as that.
constexpr double kUsualEstimates = 0.4;
constexpr double kMostEstimates = 1.0;
constexpr double kFramesOfUsual = 40.0;  ///< number of frames that count as much as the usual share

/// Least and most of the time of the frames that were not simulated, over what is extrapolated. Chosen: they hold what
/// came after the first 2 to 80 % of 25 built-in scenes and others, but for single ones, as run on one thread for it.
/// Scenes mostly calm down.
struct Spread {
    double least = 1.0;
    double most = 1.0;
};
constexpr Spread kSpreadOfFixedSteps = {0.7, 1.5};
constexpr Spread kSpreadOfTenth = {0.3, 1.7};   ///< where at least a tenth of the frames is known
constexpr Spread kSpreadOfGrowth = {0.4, 3.0};  ///< where there will be at least twice as many particles as so far, too
constexpr Spread kSpreadOfColumn = {0.3, 2.5};
constexpr Spread kSpreadOfLess = {0.15, 4.0};
constexpr Spread kSpreadOfBurst = {0.4, 10.0};  ///< where a frame took longer than all before it and was cut off

void recordMemory(Preview& preview) {
    constexpr std::size_t kFramesInFlight = 4;  // number of frames in the pipeline of the render loop
    const std::size_t count = preview.simulation.particles.count();
    if (count == 0 || count < preview.mostParticles) return;
    preview.mostParticles = count;
    preview.bytesPerParticle = engine::peakBytes(preview.simulation) / count + kFramesInFlight * sizeof(render::Sphere);
}

double processorTime() {
    timespec now = {};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Simulates one more frame, and records what that took.
void simulateFrame(const scenes::Scene& scene, Preview& preview) {
    engine::Simulation& simulation = preview.simulation;
    const double evaluations = engine::forceEvaluationsOf(simulation);
    const double estimates = simulation.automatic.estimateCost;
    preview.stepsInCutOff = 0;
    scenes::advanceToFrame(scene, simulation, preview.frames + 1);
    preview.stepsInCutOff = 0;
    ++preview.frames;
    preview.stepper = simulation.stepper;
    preview.steps = simulation.steps;
    preview.automatic = simulation.automatic;
    preview.work.push_back({engine::forceEvaluationsOf(simulation) - evaluations,
                            simulation.automatic.estimateCost - estimates,
                            static_cast<double>(simulation.particles.count())});
}

/// Simulates the first frames of a run of the scene with this setup.
/// @param enough  wall-clock time after which no further frame is begun, s
/// @param most    wall-clock time after which a frame is cut off, s
Preview previewOf(const scenes::Scene& scene, const engine::Setup& setup, double enough, double most) {
    Preview preview;
    engine::Simulation& simulation = preview.simulation;
    const auto start = std::chrono::steady_clock::now();
    const double processorStart = processorTime();
    const auto secondsSoFar = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const auto recordEnd = [&] {
        preview.seconds = secondsSoFar();
        preview.processorSeconds = processorTime() - processorStart;
        recordMemory(preview);
    };
    try {
        simulation = engine::start(setup);
        preview.stepper = simulation.stepper;
        preview.bytesOfMaterials = engine::peakBytesOfMaterials(simulation);
        recordMemory(preview);
        simulation.beforeStep = [&](const engine::Simulation&) {
            if (secondsSoFar() > most) throw engine::Stopped();
            ++preview.stepsInCutOff;
        };
        while (preview.frames + 1 < scenes::frameCount(scene) && preview.seconds < enough) {
            simulateFrame(scene, preview);
            recordEnd();
            preview.secondsOfFrames = preview.seconds;
        }
    } catch (const engine::Stopped&) {
        preview.isCutOff = true;
        recordEnd();
    } catch (const engine::InstabilityError& error) {
        preview.unstable = error.what();
    }
    simulation.beforeStep = nullptr;  // it refers to this function's variables
    return preview;
}

/// The particles nearest to an axis along gravity through the mean position, or to that point where there is none.
engine::Particles columnOf(engine::Particles particles, const Vec3& gravity) {
    const std::size_t count = particles.count();
    Vec3 middle = Vec3::Zero();
    for (const Vec3& position : particles.position) middle += position / static_cast<double>(count);
    const double length = std::sqrt(engine::squaredLength(gravity));
    const Vec3 axis = length > 0.0 ? Vec3(gravity / length) : Vec3(Vec3::Zero());
    std::vector<double> distances(count);
    for (std::size_t p = 0; p < count; ++p) {
        const Vec3 away = particles.position[p] - middle;
        const double along = engine::dot(away, axis);
        distances[p] = engine::squaredLength(away) - along * along;
    }
    std::vector<double> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + kColumnCount, sorted.end());
    keepWhere(particles, [&](std::size_t p) { return distances[p] < sorted[kColumnCount]; });
    return particles;
}

/// Mean number of force evaluations of the steps of a frame, over the later half of the frames.
double laterEvaluations(const std::vector<FrameWork>& work) {
    const std::size_t first = work.size() / 2;
    double sum = 0.0;
    for (std::size_t k = first; k < work.size(); ++k) sum += work[k].evaluations;
    return sum / static_cast<double>(work.size() - first);
}

/// Cost of error estimates over that of steps in further frames. The first frame, which compares all candidates, does
/// not count.
double estimatesShare(const engine::Setup& setup, const std::vector<FrameWork>& work) {
    if (setup.stepper != engine::StepperKind::automatic) return 0.0;
    FrameWork sum;
    for (std::size_t k = 1; k < work.size(); ++k) {
        sum.evaluations += work[k].evaluations;
        sum.estimates += work[k].estimates;
    }
    const double seen = sum.evaluations > 0.0 ? std::min(kMostEstimates, sum.estimates / sum.evaluations) : 0.0;
    const double frames = sum.evaluations > 0.0 ? static_cast<double>(work.size()) : 0.0;
    return (frames * seen + kFramesOfUsual * kUsualEstimates) / (frames + kFramesOfUsual);
}

/// How many force evaluations a frame of all of the scene takes over those of a frame of a column.
double evaluationsRatio(const std::vector<FrameWork>& all, const std::vector<FrameWork>& column) {
    constexpr std::size_t kLeastFrames = 4;  // chosen: fewer say nothing
    constexpr double kMostRatio = 3.0;       // chosen
    double ofAll = 0.0;
    double ofColumn = 0.0;
    for (std::size_t k = 1; k < std::min(all.size(), column.size()); ++k) {
        ofAll += all[k].evaluations;
        ofColumn += column[k].evaluations;
    }
    if (std::min(all.size(), column.size()) < kLeastFrames || ofColumn <= 0.0) return 1.0;
    return std::clamp(ofAll / ofColumn, 1.0 / kMostRatio, kMostRatio);
}

/// Wall-clock time of one force evaluation of one particle, s.
double secondsOfUnit(const Preview& preview) {
    double units = static_cast<double>(preview.stepsInCutOff * preview.simulation.particles.count());
    for (const FrameWork& frame : preview.work)
        units += (frame.evaluations + frame.estimates) * std::max(1.0, frame.particles);
    return preview.seconds / std::max(1.0, units);
}

/// The number of particles at the last frame, if emitters find room as often as they have so far.
double particlesAtEnd(const scenes::Scene& scene, const Preview& preview) {
    const auto planned = static_cast<double>(plannedBirths(scene, preview.simulation.time));
    const auto born = static_cast<double>(engine::birthCount(preview.simulation));
    const double share = planned > 0.0 ? born / planned : 1.0;
    const auto now = static_cast<double>(preview.simulation.particles.count());
    return now + share * (static_cast<double>(plannedBirths(scene)) - planned);
}

/// The frames from which the others are extrapolated.
struct Basis {
    const std::vector<FrameWork>& frames;
    double ratio = 1.0;  ///< force evaluations of a frame of the run over those of a frame of the basis
    Spread spread;

    /// Force evaluations of the steps of a frame, which counts from 0.
    double evaluationsOf(std::size_t frame) const {
        return ratio * (frame < frames.size() ? frames[frame].evaluations : laterEvaluations(frames));
    }
};

/// The basis that tells most; nothing if there is none.
std::optional<Basis> basisOf(const scenes::Scene& scene, const Preview& beginning, const std::optional<Preview>& column,
                             std::vector<FrameWork>& nominal) {
    constexpr double kLeastShare = 0.1;
    const double total = std::max(1, scenes::frameCount(scene) - 1);
    const auto seen = [&](const Preview& preview) { return preview.frames / total; };
    if (scene.setup.stepper != engine::StepperKind::automatic) {
        nominal.push_back({engine::stepCount(scene.fps.timeOf(1), scene.setup.step), 0.0, 0.0});
        return Basis{beginning.frames > 0 ? beginning.work : nominal, 1.0, kSpreadOfFixedSteps};
    }
    if (column && column->frames > 0 && seen(*column) > 2.0 * seen(beginning))
        return Basis{column->work, evaluationsRatio(beginning.work, column->work), kSpreadOfColumn};
    if (beginning.frames == 0) return std::nullopt;
    const bool isBurst = beginning.isCutOff && beginning.seconds > 2.0 * beginning.secondsOfFrames;
    const bool isGrowing =
        particlesAtEnd(scene, beginning) > 2.0 * static_cast<double>(beginning.simulation.particles.count());
    return Basis{beginning.work, 1.0,
                 isBurst                         ? kSpreadOfBurst
                 : seen(beginning) < kLeastShare ? kSpreadOfLess
                 : isGrowing                     ? kSpreadOfGrowth
                                                 : kSpreadOfTenth};
}

}  // namespace

std::uint64_t plannedBirths(const scenes::Scene& scene, double time) {
    std::uint64_t sum = 0;
    for (const engine::Emitter& emitter : scene.setup.emitters) sum += engine::askedCount(emitter, time);
    return sum;
}

std::uint64_t plannedBirths(const scenes::Scene& scene) {
    return plannedBirths(scene, scenes::frameTime(scene, scenes::frameCount(scene) - 1));
}

engine::Particles everyKind(const scenes::Scene& scene) {
    engine::Particles particles = scene.setup.initial;
    for (const engine::Emitter& emitter : scene.setup.emitters) {
        const engine::Material& material = scene.setup.materials[emitter.material];
        engine::append(particles, {.radius = material.radius, .mass = material.mass, .material = emitter.material});
    }
    return particles;
}

Preview simulateBeginning(const scenes::Scene& scene, double mostSeconds) {
    return previewOf(scene, scene.setup, kSecondsEnough, mostSeconds);
}

std::optional<Preview> simulateColumn(const scenes::Scene& scene) {
    if (scene.setup.initial.count() < 2 * kColumnCount) return std::nullopt;
    engine::Setup setup = scene.setup;
    setup.initial = columnOf(std::move(setup.initial), setup.gravity);
    return previewOf(scene, setup, kColumnSeconds, kMostColumnSeconds);
}

std::optional<Forecast> forecastOf(const scenes::Scene& scene, const Preview& beginning,
                                   const std::optional<Preview>& column) {
    const auto total = static_cast<std::size_t>(scenes::frameCount(scene) - 1);
    const std::size_t done = beginning.work.size();
    const double particlesNow = static_cast<double>(beginning.simulation.particles.count());
    const auto stepsDone = static_cast<double>(beginning.steps.count);
    if (done == total) return Forecast{beginning.seconds, beginning.seconds, stepsDone, particlesNow};
    std::vector<FrameWork> nominal;
    const std::optional<Basis> basis = basisOf(scene, beginning, column, nominal);
    if (!basis) return std::nullopt;
    const double unit = secondsOfUnit(beginning);
    const double last = particlesAtEnd(scene, beginning);
    const double estimates = estimatesShare(scene.setup, basis->frames);
    double seconds = 0.0;
    double evaluations = 0.0;
    for (std::size_t k = done; k < total; ++k) {
        const double share = static_cast<double>(k + 1 - done) / static_cast<double>(total - done);
        const double particles = std::max(1.0, particlesNow + share * (last - particlesNow));
        evaluations += basis->evaluationsOf(k);
        seconds += unit * basis->evaluationsOf(k) * (1.0 + estimates) * particles;
    }
    if (done == 0) seconds += unit * basis->frames[0].estimates * std::max(1.0, particlesNow);
    const double likely = std::sqrt(basis->spread.least * basis->spread.most);
    // A step of velocity Verlet, the usual one, is one force evaluation.
    const double ofSteps = done > 0 ? stepsDone / std::max(1.0, engine::forceEvaluationsOf(beginning.simulation)) : 1.0;
    return Forecast{beginning.seconds + basis->spread.least * seconds, beginning.seconds + basis->spread.most * seconds,
                    stepsDone + likely * std::min(1.0, ofSteps) * evaluations, last};
}

double secondsOfDrawing(const scenes::Scene& scene, const engine::Simulation& simulation) {
    const OpenedRenderer opened = openRenderer({}, scene.size, render::Quality::normal, 1);
    double seconds = 0.0;
    for (int k = 0; k < 2; ++k) {  // the first one warms up
        seconds = 0.0;
        const Stopwatch watch(seconds);
        render::encodePng(opened.renderer->draw(scenes::frameView(scene, simulation)));
    }
    return seconds * scenes::frameCount(scene);
}

std::string durationText(double leastSeconds, double mostSeconds) {
    struct Unit {
        double seconds;
        const char* name;
    };
    constexpr double kSameFactor = 2.0;
    constexpr double kMany = 120.0;  // of a unit, above which the next one is used; chosen
    const Unit unit = mostSeconds < kMany          ? Unit{1.0, "s"}
                      : mostSeconds < kMany * 60.0 ? Unit{60.0, "minutes"}
                                                   : Unit{3600.0, "hours"};
    const auto rounded = [&](double seconds) {
        return fmt::format("{:.0f}", std::max(1.0, std::ceil(seconds / unit.seconds)));
    };
    const std::string least = rounded(leastSeconds);
    const std::string most = rounded(mostSeconds);
    if (least == most || mostSeconds <= kSameFactor * leastSeconds)
        return fmt::format("about {} {}", rounded(std::sqrt(leastSeconds * mostSeconds)), unit.name);
    return fmt::format("{} to {} {}", least, most, unit.name);
}

}  // namespace tools
