// Evaluates runs: their errors, the orders of convergence, the automatic stepper beside fixed ones. See accuracy.h.
#include "studies/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>

#include "engine/stepping/take_step.h"
#include "studies/common/power_law.h"
#include "studies/common/state_difference.h"

namespace studies {
namespace {

using engine::StepperKind;

// Which runs an order of convergence is fitted to. Chosen; ordersOf() in accuracy.h gives the reasons.
constexpr std::size_t kMostPoints = 4;
constexpr std::size_t kFewestPoints = 3;
constexpr double kAsymptoticError = 0.05;  // largest error that may show the order, radii

/// The difference divided by the scale; 0 if the scale is 0.
double relative(double difference, double scale) {
    return scale > 0.0 ? difference / scale : 0.0;
}

void addDrifts(AccuracyRow& row, const WindowRun& run, const WindowRun& reference) {
    const engine::Energy& energy = reference.energy;
    row.energyDrift = relative(run.energy.total() - energy.total(),
                               energy.kinetic + std::abs(energy.pairs) + std::abs(energy.contacts));
    const MomentumScale scale = momentumScale(reference.particles);
    const auto drift = [&](engine::Vec3 (*momentum)(const engine::Particles&)) {
        return (momentum(run.particles) - momentum(reference.particles)).norm();
    };
    row.linearDrift = relative(drift(engine::linearMomentum), scale.linear);
    row.angularDrift = relative(drift(engine::angularMomentum), scale.angular);
}

/// Step (s) and error (radii) of the runs that a stepper's order of convergence is fitted to, the smallest step first.
std::vector<PowerLawPoint> asymptotic(const std::vector<AccuracyRow>& rows, StepperKind stepper) {
    std::vector<PowerLawPoint> points;
    for (const AccuracyRow& row : rows)
        if (isOf(row.run.variant, stepper) && row.resolved && row.run.steps.rejected == 0 &&
            row.error <= kAsymptoticError)
            points.push_back({row.run.variant.asked, row.error});
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    if (points.size() > kMostPoints) points.resize(kMostPoints);
    return points;
}

/// The fixed stepper that reaches an error (radii) at the least cost.
std::optional<HandPicked> cheapest(const std::vector<AccuracyRow>& rows, double WindowRun::*cost, double error) {
    std::optional<HandPicked> best;
    for (const StepperKind stepper : engine::kSteppers) {
        if (stepper == StepperKind::automatic) continue;
        std::vector<CostPoint> points;
        for (const AccuracyRow& row : rows)
            if (isOf(row.run.variant, stepper) && row.resolved) points.push_back({row.error, row.run.*cost});
        const auto least = costAt(points, error);
        if (least && (!best || *least < best->cost)) best = HandPicked{stepper, *least};
    }
    return best;
}

}  // namespace

AccuracyRow rowOf(const Window& window, const WindowRun& run, const Reference& reference) {
    AccuracyRow row;
    row.run = run;
    row.run.particles = {};
    if (run.ending != Ending::finished) return row;
    const PositionError positions =
        positionError(run.particles, reference.run.particles, window.start.particles.count());
    row.rms = positions.rms;
    row.largest = positions.largest;
    row.compared = positions.compared;
    row.statistics = statisticsDifference(run.particles, reference.run.particles);
    row.error = reference.facts.metric == ErrorMetric::positions ? row.rms : row.statistics;
    row.errorPerSecond = row.error / window.seconds();
    row.resolved = std::isfinite(row.error) && row.error > reference.facts.resolution;
    addDrifts(row, run, reference.run);
    return row;
}

std::vector<OrderRow> ordersOf(const std::vector<AccuracyRow>& rows) {
    std::vector<OrderRow> orders;
    for (const StepperKind stepper : engine::kSteppers) {
        if (stepper == StepperKind::automatic) continue;
        const std::vector<PowerLawPoint> points = asymptotic(rows, stepper);
        OrderRow order{stepper, std::nullopt, points.size()};
        if (!points.empty()) {
            order.shortest = points.front().x;
            order.longest = points.back().x;
        }
        if (points.size() >= kFewestPoints) order.order = powerLawExponent(points);
        orders.push_back(order);
    }
    return orders;
}

std::vector<AutoRow> autosOf(const std::vector<AccuracyRow>& rows, double windowSeconds) {
    std::vector<AutoRow> autos;
    for (const AccuracyRow& row : rows) {
        const WindowRun& run = row.run;
        if (run.variant.stepper != StepperKind::automatic || run.ending != Ending::finished) continue;
        if (!std::isfinite(row.error)) continue;
        AutoRow automatic;
        automatic.asked = run.variant.asked;
        automatic.obtained = row.errorPerSecond;
        automatic.seconds = run.seconds;
        automatic.evaluationCost = run.evaluationCost;
        automatic.resolved = row.resolved;
        const double askedError = run.variant.asked * windowSeconds;
        automatic.secondsAtObtained = cheapest(rows, &WindowRun::seconds, row.error);
        automatic.secondsAtAsked = cheapest(rows, &WindowRun::seconds, askedError);
        automatic.evaluationsAtObtained = cheapest(rows, &WindowRun::evaluationCost, row.error);
        automatic.evaluationsAtAsked = cheapest(rows, &WindowRun::evaluationCost, askedError);
        autos.push_back(automatic);
    }
    return autos;
}

}  // namespace studies
