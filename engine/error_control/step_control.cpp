// The estimates of single steps, and the filter that makes steps of them.
#include "engine/error_control/step_control.h"

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/error_control/checked_steps.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Bounds on the factor by which a step changes. Chosen: errors follow a power of the step within them.
constexpr double kLeastFactor = 1.0 / 3.0;
constexpr double kMostFactor = 2.0;

/// An error above the wanted one by more than the inverse of this is an impact, not noise: the filter is passed by.
/// Chosen.
constexpr double kImpact = 0.25;

/// A step is taken back if its error is above the wanted one by more than the inverse of this. Chosen.
constexpr double kRefused = 0.1;

/// A step shorter than this share of the wanted one, which an emission has ended, says nothing of long steps. Chosen.
constexpr double kCutShort = 0.1;

/// Limits on the ratio of wanted and estimated error, so that the filter forgets a step without any error. Chosen.
constexpr double kLeastRatio = 1e-4;
constexpr double kMostRatio = 1e4;

/// Limits on calibrations. In the scenes of the library 0.05 to 10 are measured. Below the lower limit they are not
/// believed: steps gain little, and the first impact after calm motion errs more.
constexpr double kLeastCalibration = 0.4;
constexpr double kMostCalibration = 50.0;

/// RMS over the particles of h^2/6 times the slope of the mean accelerations, in radii per second.
double fromMeanAccelerations(Simulation& simulation, const SavedState& before, double h) {
    StepCache& cache = *simulation.cache;
    const Particles& particles = simulation.particles;
    const std::size_t count = before.velocity.size();
    const std::size_t known = std::min(count, cache.meanAccelerations.size());
    cache.meanAccelerations.resize(count, Vec3::Zero());
    const double toError = h * h / 3.0 / (h + cache.lastStep);
    const double sumSq = exactSum(*simulation.ranks, count, [&](std::size_t p) {
        const Vec3 mean = (particles.velocity[p] - before.velocity[p]) / h;
        const double radius = particles.radius[p];
        const double off = squaredLength(toError * (mean - cache.meanAccelerations[p])) / (radius * radius);
        cache.meanAccelerations[p] = mean;
        return p < known ? off : 0.0;
    });
    cache.lastStep = h;
    const std::uint64_t knownOfAll = sumOfAll(*simulation.ranks, known);
    return knownOfAll == 0 ? -1.0 : std::sqrt(sumSq / static_cast<double>(knownOfAll));
}

double ratioOf(const StepControl& steps, double estimate, double wanted) {
    const double error = steps.calibration * estimate;
    return error > 0.0 ? wanted / error : kMostRatio;
}

}  // namespace

std::optional<double> estimateStep(Simulation& simulation, const SavedState& before, double h) {
    if (sumOfAll(*simulation.ranks, before.velocity.size()) == 0) return std::nullopt;
    if (isVerlet(simulation.stepper)) {
        simulation.cache->meanAccelerations.clear();
        return simulation.cache->predictionError / 3.0;
    }
    const double estimate = fromMeanAccelerations(simulation, before, h);
    return estimate < 0.0 ? std::nullopt : std::optional(estimate);
}

void control(StepControl& steps, StepperKind stepper, double h, double estimate, double wanted) {
    double ratio = ratioOf(steps, estimate, wanted);
    if (h < kCutShort * steps.step && ratio > 1.0) return;
    ratio = std::clamp(ratio * errorRatio(stepper, std::min(1.0, h / steps.step)), kLeastRatio, kMostRatio);
    const bool isFirst = steps.stepBefore == 0.0;
    const double ratioBefore = isFirst ? ratio : steps.ratioBefore;
    const double changeBefore = isFirst ? 1.0 : steps.step / steps.stepBefore;
    // (ratio ratioBefore)^(1/8) changeBefore^(-1/4) for a stepper of second order
    double factor = std::sqrt(std::sqrt(stepRatio(stepper, ratio * ratioBefore) / changeBefore));
    if (ratio < kImpact) factor = std::min(factor, 0.9 * stepRatio(stepper, ratio));
    steps.ratioBefore = ratio;
    steps.stepBefore = steps.step;
    steps.step = std::max(kShortestStep, steps.step * std::clamp(factor, kLeastFactor, kMostFactor));
}

void calibrate(StepControl& steps, double error, double estimate) {
    if (!(error > 0.0 && estimate > 0.0)) return;
    constexpr double kLess = 1.0 / 4.0;
    constexpr double kMore = 16.0;
    const double seen = std::clamp(error / estimate, kLess * steps.calibration, kMore * steps.calibration);
    const double mean = steps.isCalibrated ? std::sqrt(seen * steps.calibration) : seen;
    steps.calibration = std::clamp(mean, kLeastCalibration, kMostCalibration);
    steps.isCalibrated = true;
}

bool isPossible(const StepControl& steps) {
    const bool isUnused = steps.step == 0.0;
    return (isUnused || steps.step >= kShortestStep) && std::isfinite(steps.step) && steps.stepBefore >= 0.0 &&
           std::isfinite(steps.stepBefore) && steps.ratioBefore > 0.0 && steps.calibration >= kLeastCalibration &&
           steps.calibration <= kMostCalibration;
}

bool isRefused(const StepControl& steps, double estimate, double wanted) {
    return steps.isCalibrated && ratioOf(steps, estimate, wanted) < kRefused;
}

}  // namespace engine
