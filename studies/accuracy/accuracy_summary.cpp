// Rows, orders and the comparison with hand-picked steppers.
#include "studies/accuracy/accuracy_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/stepping/steppers.h"
#include "studies/common/order_fit.h"
#include "studies/common/pareto_front.h"
#include "studies/common/position_error.h"

namespace studies {
namespace {

using engine::StepperKind;

constexpr std::size_t kMostPoints = 4;
constexpr std::size_t kFewestPoints = 3;
constexpr double kAsymptoticError = 0.05;  // radii

double length(const engine::Vec3& vector) {
    return std::sqrt(engine::squaredLength(vector));
}

/// A share of a sum of sizes; 0 where nothing has any size.
double over(double sum, double difference) {
    return sum > 0.0 ? difference / sum : 0.0;
}

struct MomentumSizes {
    double linear = 0.0;   ///< kg m/s
    double angular = 0.0;  ///< kg m^2/s
};

MomentumSizes sizesOf(const engine::Particles& particles) {
    MomentumSizes sizes;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const engine::Vec3 momentum = particles.mass[p] * particles.velocity[p];
        sizes.linear += length(momentum);
        sizes.angular += length(particles.position[p].cross(momentum));
    }
    return sizes;
}

void addDrifts(AccuracyRow& row, const WindowRun& run, const WindowRun& reference) {
    const engine::Energy& energy = reference.energy;
    row.energyDrift =
        over(energy.kinetic + std::abs(energy.pairs) + std::abs(energy.contacts), run.energy.total() - energy.total());
    const MomentumSizes sizes = sizesOf(reference.particles);
    row.linearDrift =
        over(sizes.linear, length(engine::linearMomentum(run.particles) - engine::linearMomentum(reference.particles)));
    row.angularDrift = over(
        sizes.angular, length(engine::angularMomentum(run.particles) - engine::angularMomentum(reference.particles)));
}

/// The points that show a stepper's order, finest first.
std::vector<StepError> asymptotic(const std::vector<AccuracyRow>& rows, StepperKind stepper) {
    std::vector<StepError> points;
    for (const AccuracyRow& row : rows)
        if (isOf(row.run.variant, stepper) && row.resolved && row.run.steps.rejected == 0 &&
            row.error <= kAsymptoticError)
            points.push_back({row.run.variant.asked, row.error});
    std::sort(points.begin(), points.end(), [](const StepError& a, const StepError& b) { return a.step < b.step; });
    if (points.size() > kMostPoints) points.resize(kMostPoints);
    return points;
}

using Cost = double (*)(const WindowRun&);

double timeOf(const WindowRun& run) {
    return run.seconds;
}

double evaluationCostOf(const WindowRun& run) {
    return run.evaluationCost;
}

std::optional<HandPicked> cheapest(const std::vector<AccuracyRow>& rows, Cost cost, double error) {
    std::optional<HandPicked> best;
    for (const StepperKind stepper : engine::kSteppers) {
        if (stepper == StepperKind::automatic) continue;
        std::vector<CostPoint> points;
        for (const AccuracyRow& row : rows)
            if (isOf(row.run.variant, stepper) && row.resolved) points.push_back({row.error, cost(row.run)});
        const auto price = costAt(points, error);
        if (price && (!best || *price < best->cost)) best = HandPicked{stepper, *price};
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
    row.error = reference.facts.measure == ErrorMetric::positions ? row.rms : row.statistics;
    row.errorPerSecond = row.error / window.seconds();
    row.resolved = std::isfinite(row.error) && row.error > reference.facts.resolution;
    addDrifts(row, run, reference.run);
    return row;
}

std::vector<OrderRow> ordersOf(const std::vector<AccuracyRow>& rows) {
    std::vector<OrderRow> orders;
    for (const StepperKind stepper : engine::kSteppers) {
        if (stepper == StepperKind::automatic) continue;
        const std::vector<StepError> points = asymptotic(rows, stepper);
        OrderRow order{stepper, std::nullopt, points.size()};
        if (!points.empty()) {
            order.shortest = points.front().step;
            order.longest = points.back().step;
        }
        if (points.size() >= kFewestPoints) order.order = fittedOrder(points);
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
        automatic.secondsAtObtained = cheapest(rows, timeOf, row.error);
        automatic.secondsAtAsked = cheapest(rows, timeOf, askedError);
        automatic.evaluationsAtObtained = cheapest(rows, evaluationCostOf, row.error);
        automatic.evaluationsAtAsked = cheapest(rows, evaluationCostOf, askedError);
        autos.push_back(automatic);
    }
    return autos;
}

}  // namespace studies
