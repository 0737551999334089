// Finds the reference run of the study of accuracy: chooses the stepper by the measured runs, then halves its step
// until the result no longer changes noticeably. See reference.h.
#include "studies/accuracy/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "engine/stepping/take_step.h"
#include "studies/common/state_difference.h"

namespace studies {
namespace {

/// How far the start of the twin run is displaced, radii. Chosen: small beside any error, large beside the rounding of
/// a position (1e-16 m at radii of 0.1 m).
constexpr double kTwinDistance = 1e-9;

/// Tolerance of the linear solver in reference runs. Chosen: its errors stay below the change by halving the step.
constexpr double kReferenceSolverTolerance = 1e-10;

/// If two runs from nearly the same state end further apart than this share of the smallest error, the motion is
/// chaotic: positions show how rounding errors are amplified, not how good the steppers are. Chosen.
constexpr double kChaoticShare = 0.1;

/// Chosen: the reference is fine enough if halving its step changes it by at most this share of the smallest error.
constexpr double kSettledShare = 0.05;

/// An error is resolved if it is this many times the change that the last halving of the reference's step made; it is
/// then known to within a third. Chosen.
constexpr double kResolvedFactor = 3.0;

/// The two finest finished runs of a stepper, the finest last; empty if fewer than two finished.
std::vector<const WindowRun*> finestTwo(const std::vector<WindowRun>& runs, engine::StepperKind stepper) {
    std::vector<const WindowRun*> finished;
    for (const WindowRun& run : runs)
        if (isOf(run.variant, stepper) && run.ending == Ending::finished) finished.push_back(&run);
    if (finished.size() < 2) return {};
    return {finished.end()[-2], finished.end()[-1]};
}

/// The metric by which two fine runs are compared: positions, unless their particles were born at different times.
ErrorMetric metricFor(const engine::Particles& a, const engine::Particles& b) {
    return sameBirths(a, b) ? ErrorMetric::positions : ErrorMetric::statistics;
}

/// A number by which steppers of order 2 are compared: the change C from the second finest run to the finest, times the
/// square of the finest run's cost. For order 2, C ~ h^2 ~ cost^-2, so the product is the change at unit cost.
double changeAtUnitCost(const Window& window, const std::vector<const WindowRun*>& two) {
    const double cost = two[1]->evaluationCost;
    const engine::Particles& coarse = two[0]->particles;
    const engine::Particles& fine = two[1]->particles;
    return difference(window, metricFor(coarse, fine), coarse, fine) * cost * cost;
}

/// The finest run of velocity Verlet or of implicit damping, whichever stepper is more accurate at the same cost.
/// @throws engine::InstabilityError if neither finished two runs
const WindowRun& finestOfBetterStepper(const Window& window, const std::vector<WindowRun>& runs) {
    const WindowRun* best = nullptr;
    double least = kInfinity;
    for (const auto stepper : {engine::StepperKind::velocityVerlet, engine::StepperKind::implicitDamping}) {
        const auto two = finestTwo(runs, stepper);
        const double change = two.empty() ? kInfinity : changeAtUnitCost(window, two);
        if (change < least) best = two[1];
        least = std::min(least, change);
    }
    if (best != nullptr) return *best;
    std::string message;
    for (const WindowRun& run : runs)
        if (message.empty()) message = run.failureMessage;
    throw engine::InstabilityError(fmt::format(
        "neither velocity-verlet nor implicit-damping finished the window twice, so there is no reference; {}",
        message.empty() ? "all runs were too slow" : message));
}

/// The smallest error of all finished runs against a reference, radii; infinite if no run has finished.
double smallestError(const Window& window, ErrorMetric metric, const std::vector<WindowRun>& runs,
                     const engine::Particles& reference) {
    double smallest = kInfinity;
    for (const WindowRun& run : runs) {
        if (run.ending != Ending::finished) continue;
        smallest = std::min(smallest, difference(window, metric, run.particles, reference));
    }
    return smallest;
}

/// Runs the window of the scene to its end without a time limit.
/// @throws engine::InstabilityError
WindowRun runWhole(const Window& window, const Variant& variant, std::string_view purpose,
                   const RunListener& listener) {
    WindowRun run = runWindow(window, variant, kInfinity);
    listener(run, purpose);
    if (run.ending != Ending::finished) throw engine::InstabilityError(run.failureMessage);
    return run;
}

}  // namespace

std::string_view nameOf(ErrorMetric metric) {
    return metric == ErrorMetric::positions ? "positions" : "statistics";
}

double statisticsDifference(const engine::Particles& particles, const engine::Particles& reference) {
    if (reference.count() == 0) return 0.0;
    const double radius =
        std::accumulate(reference.radius.begin(), reference.radius.end(), 0.0) / static_cast<double>(reference.count());
    return largestDifference(bulkStatistics(particles), bulkStatistics(reference)) / radius;
}

double difference(const Window& window, ErrorMetric metric, const engine::Particles& a, const engine::Particles& b) {
    if (metric == ErrorMetric::statistics) return statisticsDifference(a, b);
    return positionError(a, b, window.start.particles.count()).rms;
}

Reference findReference(const Window& window, const std::vector<WindowRun>& runs, double budget,
                        const RunListener& listener) {
    const WindowRun& finest = finestOfBetterStepper(window, runs);
    Window displacedWindow = window;
    displacedWindow.start.particles = displaced(std::move(displacedWindow.start.particles), kTwinDistance);
    const WindowRun twin = runWhole(displacedWindow, finest.variant, "twin", listener);

    Reference reference;
    ReferenceFacts& facts = reference.facts;
    facts.variant = {finest.variant.stepper, finest.variant.asked / 4.0, kReferenceSolverTolerance};
    reference.run = runWhole(window, facts.variant, "reference", listener);
    double spent = reference.run.seconds;
    facts.twinSeparation =
        difference(window, metricFor(twin.particles, finest.particles), twin.particles, finest.particles);
    const double smallest = smallestError(window, ErrorMetric::positions, runs, reference.run.particles);
    facts.birthsDiffer =
        !sameBirths(finest.particles, reference.run.particles) || !sameBirths(twin.particles, reference.run.particles);
    if (facts.birthsDiffer || facts.twinSeparation > kChaoticShare * smallest) facts.metric = ErrorMetric::statistics;
    do {
        facts.variant.asked /= 2.0;
        WindowRun halved = runWhole(window, facts.variant, "reference", listener);
        spent += halved.seconds;
        facts.birthsDiffer = facts.birthsDiffer || !sameBirths(reference.run.particles, halved.particles);
        if (facts.birthsDiffer) facts.metric = ErrorMetric::statistics;
        facts.change = difference(window, facts.metric, reference.run.particles, halved.particles);
        reference.run = std::move(halved);
        facts.settled =
            facts.change <= kSettledShare * smallestError(window, facts.metric, runs, reference.run.particles);
    } while (!facts.settled && spent + 2.0 * reference.run.seconds <= budget);
    facts.seconds = reference.run.seconds;
    facts.resolution =
        kResolvedFactor * std::max(facts.change, difference(window, facts.metric, twin.particles, finest.particles));
    return reference;
}

}  // namespace studies
