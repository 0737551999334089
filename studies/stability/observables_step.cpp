// Observables of the stepping itself: the bound of the step, the order of convergence, the cost beside explicit steps.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/core/random.h"
#include "engine/stepping/state_checks.h"
#include "engine/stepping/step_bound.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/steppers.h"
#include "scenes/text/input_error.h"
#include "studies/common/infinity.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Simulation;
using engine::StepperKind;

engine::ForceLaw lawOf(const engine::Setup& setup) {
    return {setup.materials, setup.gravity, setup.obstacles};
}

/// The explicit stepper whose limit is asked for: the scene's own if it is one.
StepperKind explicitStepper(const scenes::Scene& scene) {
    const StepperKind own = scene.setup.stepper;
    return own == StepperKind::symplecticEuler || engine::isVerlet(own) ? own : StepperKind::velocityVerlet;
}

double boundOf(const ObservableInput& trial, StepperKind stepper) {
    const auto bound = engine::stepBound(lawOf(trial.scene.setup), trial.run.end.particles, stepper);
    return bound ? bound->seconds : kInfinity;
}

/// The state at the end of a run, ready for steps of another stepper.
Simulation continued(const Run& run, StepperKind stepper) {
    Simulation simulation = run.end;
    simulation.setup.stepper = simulation.stepper = stepper;
    simulation.setup.emitters.clear();
    simulation.emitters.clear();
    simulation.cache->forcesCurrent = false;
    return simulation;
}

double rmsDistance(const engine::Particles& a, const engine::Particles& b) {
    double sum = 0.0;
    for (std::size_t p = 0; p < a.count(); ++p) sum += (a.position[p] - b.position[p]).squaredNorm();
    return std::sqrt(sum / static_cast<double>(a.count()));
}

/// Twins a thousand-millionth of a meter apart part company at an unstable step: whether they do within kSteps.
bool isStable(const Simulation& state, double h) {
    constexpr int kSteps = 200;      // chosen: a mode that grows by 3.5 % a step is found out
    constexpr double kApart = 1e-9;  // m, chosen: far above rounding, far below a radius
    constexpr double kGrowth = 1000.0;
    Simulation one = state;
    Simulation other = state;
    for (std::size_t p = 0; p < other.particles.count(); ++p)
        for (int axis = 0; axis < 3; ++axis)
            other.particles.position[p][axis] +=
                kApart * engine::symmetricUnit(engine::randomBits(1, static_cast<std::uint64_t>(axis), p));
    other.cache->evaluator.invalidateDisplacementBound();
    const double before = rmsDistance(one.particles, other.particles);
    for (int step = 0; step < kSteps; ++step) {
        engine::takeStep(one, h);
        engine::takeStep(other, h);
        // Written so that a NaN fails.
        if (!(rmsDistance(one.particles, other.particles) < kGrowth * before)) return false;
    }
    return true;
}

/// The largest stable step at a state, by bisection between a quarter of a guess and four times it.
double measuredLimit(const Simulation& state, double guess) {
    double stable = 0.25 * guess;
    double unstable = 4.0 * guess;
    if (!isStable(state, stable)) return stable;
    if (isStable(state, unstable)) return unstable;
    while (unstable > 1.01 * stable) {
        const double middle = std::sqrt(stable * unstable);
        (isStable(state, middle) ? stable : unstable) = middle;
    }
    return stable;
}

/// The particles after a number of equal steps through the scene, none of them judged or taken back.
/// Throws: engine::InstabilityError.
engine::Particles endAfter(const scenes::Scene& scene, int steps) {
    Simulation simulation = engine::start(scene.setup);
    const double h = scene.duration / steps;
    for (int step = 0; step < steps; ++step) {
        engine::takeStep(simulation, h);
        engine::requireValid(simulation, h);
    }
    return simulation.particles;
}

}  // namespace

/// The step bound at the end of the run over the largest stable step there, of the scene's stepper if it is explicit
/// and of velocity Verlet otherwise.
double stepBound(const ObservableInput& trial) {
    const StepperKind stepper = explicitStepper(trial.scene);
    const double bound = boundOf(trial, stepper);
    if (!std::isfinite(bound)) return kInfinity;
    return bound / measuredLimit(continued(trial.run, stepper), bound);
}

/// The order p from the ends of runs at h, h/2 and h/4: their distances are C h^p (1 - 2^-p) and 2^-p of that.
double order(const ObservableInput& trial) {
    if (!trial.scene.setup.emitters.empty() || trial.scene.setup.stepper == StepperKind::automatic)
        throw scenes::InputError({{trial.scene.sourceName, 0, 0,
                                   "an order is that of one stepper, and of particles that are there from the start"}});
    const int steps = static_cast<int>(std::lround(trial.scene.duration / trial.scene.setup.step));
    const engine::Particles whole = endAfter(trial.scene, steps);
    const engine::Particles half = endAfter(trial.scene, 2 * steps);
    const engine::Particles quarter = endAfter(trial.scene, 4 * steps);
    return std::log2(rmsDistance(whole, half) / rmsDistance(half, quarter));
}

/// Seconds of the run for a second of the scene, over those of velocity Verlet from the state at the end, at nine
/// tenths of its step bound.
double cost(const ObservableInput& trial) {
    constexpr int kSteps = 20;  // chosen: enough for a time, few beside the run
    const double h = 0.9 * boundOf(trial, StepperKind::velocityVerlet);
    Simulation simulation = continued(trial.run, StepperKind::velocityVerlet);
    const auto begin = std::chrono::steady_clock::now();
    for (int step = 0; step < kSteps; ++step) engine::takeStep(simulation, h);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return trial.run.seconds / trial.run.end.time / (seconds / (kSteps * h));
}

}  // namespace studies
