// What the runs of a scene amount to: a row for each, the order each stepper shows, and how good the automatic stepper
// is beside the best one picked by hand.
#pragma once

#include <optional>
#include <vector>

#include "studies/common/reference.h"
#include "studies/common/window_run.h"

namespace studies {

/// One run against the reference, both at the end of the window.
struct AccuracyRow {
    WindowRun run;                ///< without its particles
    double rms = 0.0;             ///< position error over the particles, radii
    double largest = 0.0;         ///< position error of the worst particle, radii
    std::size_t compared = 0;     ///< particles in both; those from before the window where later births differ
    double statistics = 0.0;      ///< error of the statistics, radii
    double error = 0.0;           ///< the one of the scene's measure, radii
    double errorPerSecond = 0.0;  ///< over the length of the window
    /// Energy less that of the reference, over its kinetic energy and the sizes of its pair and contact energies.
    double energyDrift = 0.0;
    double linearDrift = 0.0;   ///< distance from the reference's momentum, over its sum of |p|
    double angularDrift = 0.0;  ///< distance from the reference's angular momentum, over its sum of |x x p|
    bool resolved = false;      ///< finished, and the error is large enough to be told from the reference's own
};

AccuracyRow rowOf(const Window& window, const WindowRun& run, const Reference& reference);

/// Fitted order of a fixed stepper.
struct OrderRow {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    std::optional<double> order;  ///< nothing with fewer than three points
    std::size_t points = 0;
    double longest = 0.0;   ///< step of the points, s
    double shortest = 0.0;  ///< s
};

/// Uses each stepper's finest resolved runs, four at most, that took no step back and err by at most 0.05 radii:
/// beyond that the error is no longer small beside the distances over which the forces change.
std::vector<OrderRow> ordersOf(const std::vector<AccuracyRow>& rows);

/// The cheapest fixed stepper for some error, by what it costs.
struct HandPicked {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double cost = 0.0;
};

/// The automatic stepper's run for one wanted error.
struct AutoRow {
    double asked = 0.0;     ///< radii per second of motion
    double obtained = 0.0;  ///< radii per second of motion
    double seconds = 0.0;
    double evaluationCost = 0.0;
    bool resolved = false;
    /// Cheapest at the error that was obtained and at the one that was asked; nothing where no fixed run errs as
    /// little.
    std::optional<HandPicked> secondsAtObtained, secondsAtAsked;
    std::optional<HandPicked> evaluationsAtObtained, evaluationsAtAsked;
};

/// A row for each finished automatic run, against the resolved fixed ones.
std::vector<AutoRow> autosOf(const std::vector<AccuracyRow>& rows, double windowSeconds);

}  // namespace studies
