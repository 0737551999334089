// Observables of time stepping: the step bound, the order of convergence, and the cost beside explicit steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/state/state_checks.h"
#include "engine/stepping/step_bound.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"
#include "scenes/text/input_error.h"
#include "studies/common/state_difference.h"
#include "studies/common/timing.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

using engine::Simulation;
using engine::StepperKind;

/// The explicit stepper whose step bound is checked: the scene's own if it is explicit, else velocity Verlet.
StepperKind explicitStepper(const scenes::Scene& scene) {
    const StepperKind own = scene.setup.stepper;
    return own == StepperKind::symplecticEuler || engine::isVerlet(own) ? own : StepperKind::velocityVerlet;
}

/// The engine's step bound for the state at the end of the run, s; infinite if there is none.
double boundOf(const ObservableInput& input, StepperKind stepper) {
    const auto bound = engine::stepBound(forceFieldOf(input.scene.setup), input.run.end.particles, stepper);
    return bound ? bound->seconds : std::numeric_limits<double>::infinity();
}

/// Root mean square distance of corresponding particles of two states, radii.
double rmsDistance(const engine::Particles& a, const engine::Particles& b) {
    return positionError(a, b, a.count()).rms;
}

/// A simulation that continues from the end of a run with another stepper and without further births.
Simulation continued(const Run& run, StepperKind stepper) {
    Simulation simulation = run.end;
    simulation.setup.stepper = simulation.stepper = stepper;
    simulation.setup.emitters.clear();
    simulation.emitters.clear();
    simulation.cache->forcesCurrent = false;
    return simulation;
}

/// Whether steps of length h (s) are stable: whether two runs from nearly the same state stay close to each other. At
/// an unstable step their distance grows exponentially.
bool isStable(const Simulation& state, double h) {
    constexpr int kSteps = 200;      // number of steps; chosen: finds a mode that grows by 3.5 % a step
    constexpr double kApart = 1e-9;  // initial distance of the two runs, radii; chosen: far above rounding
    constexpr double kGrowth = 1000.0;
    Simulation one = state;
    Simulation other = state;
    other.particles = displaced(std::move(other.particles), kApart);
    const double before = rmsDistance(one.particles, other.particles);
    for (int step = 0; step < kSteps; ++step) {
        engine::takeStep(one, h);
        engine::takeStep(other, h);
        // The comparison is negated so that NaN counts as unstable.
        if (!(rmsDistance(one.particles, other.particles) < kGrowth * before)) return false;
    }
    return true;
}

/// The largest stable step from a state, s, to 1 %, by bisection between a quarter of a guess and four times the guess.
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

/// The particles at the end of a scene that is run in a number of equal steps, without checks of their accuracy.
/// @throws engine::InstabilityError
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

/// Observable: the engine's step bound at the end of a run, over the largest step that is measured to be stable there.
double stepBound(const ObservableInput& input) {
    const StepperKind stepper = explicitStepper(input.scene);
    const double bound = boundOf(input, stepper);
    if (!std::isfinite(bound)) return bound;
    return bound / measuredLimit(continued(input.run, stepper), bound);
}

/// Observable: the order p of convergence, from the ends of runs at steps of h, h/2 and h/4. If the errors are C h^p,
/// the first two runs end C h^p (1 - 2^-p) apart and the last two 2^-p times as far, so p is the binary logarithm of
/// the ratio of the two distances.
double order(const ObservableInput& input) {
    if (!input.scene.setup.emitters.empty() || input.scene.setup.stepper == StepperKind::automatic)
        throw scenes::InputError(input.scene.sourceName,
                                 "an order is that of one stepper, and of particles that are there from the start");
    const int steps = static_cast<int>(std::lround(input.scene.duration / input.scene.setup.step));
    const engine::Particles whole = endAfter(input.scene, steps);
    const engine::Particles half = endAfter(input.scene, 2 * steps);
    const engine::Particles quarter = endAfter(input.scene, 4 * steps);
    return std::log2(rmsDistance(whole, half) / rmsDistance(half, quarter));
}

/// Observable: wall-clock time of the run per second of the scene, over that of velocity Verlet with steps of nine
/// tenths of its step bound, measured from the state at the end of the run.
double cost(const ObservableInput& input) {
    constexpr int kSteps = 20;  // number of timed steps; chosen: few beside those of the run
    const double h = 0.9 * boundOf(input, StepperKind::velocityVerlet);
    Simulation simulation = continued(input.run, StepperKind::velocityVerlet);
    const double secondsPerStep = secondsOf([&] { engine::takeStep(simulation, h); }, kSteps);
    return input.run.seconds / input.run.end.time / (secondsPerStep / h);
}

}  // namespace studies
