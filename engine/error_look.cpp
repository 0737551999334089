// Two runs from one state.
#include "engine/error_look.h"

#include <cmath>

#include "engine/audited_steps.h"
#include "engine/steppers.h"

namespace engine {
namespace {

/// Two runs whose mean steps differ by less tell nothing about the order; the audit shortened both.
constexpr double kLeastContrast = 0.3;

Simulation run(const Simulation& from, double time, StepperKind stepper, double step) {
    Simulation simulation = from;
    if (simulation.stepper != stepper) {
        simulation.stepper = stepper;
        simulation.energy.reset();  // steppers know it at different moments of a step
        simulation.restriction = {};
    }
    simulation.steps = {};
    if (stepper == StepperKind::symplecticEuler) {
        simulation.setup.step = step;
        advance(simulation, time);
    } else {
        advanceAudited(simulation, time, step, StepLimit::error);
    }
    return simulation;
}

/// rms of dx + T dv over the particles that were there at the start, in radii.
double difference(const Simulation& a, const Simulation& b, std::size_t count) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const Vec3 apart = a.particles.position[p] - b.particles.position[p] +
                           kErrorHorizon * (a.particles.velocity[p] - b.particles.velocity[p]);
        sumSq += squaredLength(apart) / (a.particles.radius[p] * a.particles.radius[p]);
    }
    return count == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(count));
}

}  // namespace

double passesOf(const StepStatistics& steps) {
    const auto takenBy = [&](StepperKind stepper) {
        return static_cast<double>(steps.takenBy[static_cast<std::size_t>(stepper)]);
    };
    const double matrices = takenBy(StepperKind::implicitDamping) + takenBy(StepperKind::linearlyImplicit);
    return static_cast<double>(steps.forceEvaluations) + kMatrixCost * matrices +
           kProductCost * static_cast<double>(steps.products);
}

Trial measure(const Simulation& simulation, double time, StepperKind stepper, double step, Simulation* finer) {
    const double interval = time - simulation.time;
    const Simulation whole = run(simulation, time, stepper, step);
    const auto meanStep = [&](const Simulation& s) { return interval / static_cast<double>(s.steps.count); };
    // Where the audit or births shortened the steps of the first run, those of the second are half as long again.
    Simulation halves = run(simulation, time, stepper, 0.5 * meanStep(whole));
    const double ratio = meanStep(halves) / meanStep(whole);
    const double contrast = std::max(kLeastContrast, 1.0 - (orderOf(stepper) == 1 ? ratio : ratio * ratio));
    Trial trial;
    trial.stepper = stepper;
    trial.asked = interval / std::ceil(interval / step * (1.0 - 1e-9));
    trial.step = meanStep(whole);
    trial.error = difference(whole, halves, simulation.particles.count()) / contrast / interval;
    trial.cost = passesOf(whole.steps) / interval;
    trial.spent = passesOf(whole.steps) + passesOf(halves.steps);
    trial.restricted = whole.steps.rejected > 0 || whole.restriction.seconds < step;
    if (trial.restricted) trial.reason = whole.restriction.reason;
    if (finer != nullptr) *finer = std::move(halves);
    return trial;
}

}  // namespace engine
