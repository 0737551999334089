// Takes the windows out of a run of the automatic stepper, makes their references and measures errors. See
// whole_windows.h.
#include "studies/accuracy/whole_windows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/error_control/step_cost.h"
#include "engine/stepping/take_step.h"
#include "studies/common/state_difference.h"

namespace studies {
namespace {

using engine::StepperKind;

/// The first step of the reference is the mean step of the run over this. Chosen: its error is a sixteenth.
constexpr double kFinerReference = 4.0;

/// The step of the reference is halved again if the last halving changed more than this share of the wanted error, at
/// most kMostHalvings times. Chosen: by then the error of the reference is a thirtieth of the wanted one.
constexpr double kSettledByHalving = 0.1;
constexpr int kMostHalvings = 3;

/// Tolerance of the solver of implicit references. Chosen: far below the errors that are measured.
constexpr double kSolverTolerance = 1e-7;

std::uint64_t implicitStepsOf(const engine::Simulation& simulation) {
    const auto takenBy = [&](StepperKind stepper) {
        return simulation.steps.takenBy[static_cast<std::size_t>(stepper)];
    };
    return takenBy(StepperKind::implicitDamping) + takenBy(StepperKind::linearlyImplicit);
}

/// What a window needs of a simulation, without neighbor lists and whatever else one step leaves for the next.
engine::Simulation stateOf(const engine::Simulation& simulation) {
    engine::Simulation state;
    state.setup = simulation.setup;
    state.particles = simulation.particles;
    state.emitters = simulation.emitters;
    state.time = simulation.time;
    return state;
}

/// Opens and closes the windows of a run as it goes by.
class WindowRecorder {
 public:
    WindowRecorder(const scenes::Scene& scene, int windowCount, double windowSeconds)
        : scene_(scene), frames_(lastFrameOf(scene)) {
        length_ = std::min(frames_, static_cast<int>(std::ceil(scene.fps.framesIn(windowSeconds) - 1e-9)));
        count_ = std::clamp(frames_ / (2 * length_), 1, windowCount);
    }

    /// Takes note of the simulation at a frame.
    void pass(const engine::Simulation& simulation, int frame) {
        if (!windows_.empty() && windows_.back().window.lastFrame == frame) close(simulation, windows_.back());
        if (opened_ == count_ || frame != (2 * opened_ + 1) * (frames_ - length_) / (2 * count_)) return;
        ++opened_;
        if (simulation.particles.count() > 0) open(simulation, frame);
    }

    std::vector<WholeWindow> windows() && { return std::move(windows_); }

 private:
    void open(const engine::Simulation& simulation, int frame) {
        windows_.emplace_back().window = {scene_, stateOf(simulation), frame, frame + length_};
        stepsBefore_ = simulation.steps.count;
        implicitBefore_ = implicitStepsOf(simulation);
        costBefore_ = engine::forceEvaluationsOf(simulation);
    }

    void close(const engine::Simulation& simulation, WholeWindow& window) const {
        const std::uint64_t steps = simulation.steps.count - stepsBefore_;
        window.automatic = simulation.particles;
        window.meanStep = window.window.seconds() / static_cast<double>(steps);
        window.isImplicit = 2 * (implicitStepsOf(simulation) - implicitBefore_) > steps;
        window.evaluationCost = engine::forceEvaluationsOf(simulation) - costBefore_;
    }

    const scenes::Scene& scene_;
    int frames_, length_, count_;
    int opened_ = 0;
    std::vector<WholeWindow> windows_;
    std::uint64_t stepsBefore_ = 0, implicitBefore_ = 0;
    double costBefore_ = 0.0;
};

}  // namespace

int lastFrameOf(const scenes::Scene& scene) {
    return std::max(1, scenes::frameCount(scene) - 1);
}

AutomaticRun runAutomatically(const scenes::Scene& scene, int windowCount, double windowSeconds) {
    engine::Setup setup = scene.setup;
    setup.stepper = StepperKind::automatic;
    engine::Simulation simulation = engine::start(setup);
    WindowRecorder recorder(scene, windowCount, windowSeconds);
    recorder.pass(simulation, 0);
    AutomaticRun result;
    result.run = timeFrames(scene, simulation, 0, lastFrameOf(scene), kInfinity,
                            [&](int frame) { recorder.pass(simulation, frame); });
    if (result.run.ending != Ending::finished) throw engine::InstabilityError(result.run.failureMessage);
    result.run.variant = {StepperKind::automatic, setup.error, {}};
    result.windows = std::move(recorder).windows();
    return result;
}

void findReference(WholeWindow& window, double wanted, const RunListener& listener) {
    Variant variant{window.isImplicit ? StepperKind::implicitDamping : StepperKind::velocityVerlet,
                    window.meanStep / kFinerReference, kSolverTolerance};
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings, variant.asked /= 2.0) {
        WindowRun run = runWindow(window.window, variant, kInfinity);
        listener(run, "reference");
        if (run.ending != Ending::finished) throw engine::InstabilityError(run.failureMessage);
        std::swap(window.reference, run.particles);
        if (halvings == 0) continue;
        window.change = errorOf(window, run.particles);
        if (window.change <= kSettledByHalving * wanted) return;
    }
}

double errorOf(const WholeWindow& window, const engine::Particles& particles) {
    const engine::Particles& reference = window.reference;
    const std::uint32_t end = window.window.start.particles.nextId;
    double sumSq = 0.0;
    std::size_t both = 0;
    for (std::size_t p = 0, r = 0; p < particles.count() && r < reference.count();) {
        const std::uint32_t id = particles.id[p];
        const std::uint32_t referenceId = reference.id[r];
        if (std::min(id, referenceId) >= end) break;
        if (id == referenceId) {
            const double radius = reference.radius[r];
            sumSq += engine::squaredLength(particles.position[p] - reference.position[r]) / (radius * radius);
            ++both;
        }
        if (id <= referenceId) ++p;
        if (id >= referenceId) ++r;
    }
    return both == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(both)) / window.window.seconds();
}

}  // namespace studies
