// Speed against error of one scene: every stepper over a range of steps, from one state over one window of time,
// compared with a reference run that is fine enough. Called by `globular study accuracy`, which writes the results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/accuracy/reference.h"
#include "studies/accuracy/window_run.h"

namespace studies {

struct AccuracySettings {
    int firstFrame = 0;  ///< of the window
    int frameCount = 15;
    std::vector<int> stepsPerFrame = {1, 2, 4, 8, 16, 32, 64};    ///< of the fixed steppers, rising
    std::vector<double> errors = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3};  ///< asked of the automatic stepper, radii per second
    int rounds = 3;                  ///< how often each run is timed; long runs fewer times, short ones more
    double runLimit = 60.0;          ///< s; a run that takes longer is given up as too slow
    double referenceBudget = 180.0;  ///< s, for all runs of the reference together
};

/// One run compared with the reference at the end of the window.
struct AccuracyRow {
    WindowRun run;                ///< without its particles
    double rms = 0.0;             ///< position error over the compared particles, radii
    double largest = 0.0;         ///< position error of the worst particle, radii
    std::size_t compared = 0;     ///< number of particles compared, see positionError()
    double statistics = 0.0;      ///< error of the bulk statistics, radii
    double error = 0.0;           ///< rms or statistics, by the error metric of the scene, radii
    double errorPerSecond = 0.0;  ///< error over the length of the window, radii/s
    /// Difference from the reference's energy, over the reference's kinetic energy plus the magnitudes of its pair and
    /// contact energies.
    double energyDrift = 0.0;
    double linearDrift = 0.0;   ///< distance from the reference's momentum, over its sum of |p|
    double angularDrift = 0.0;  ///< distance from the reference's angular momentum, over its sum of |x x p|
    bool resolved = false;      ///< whether the run finished with an error well above the reference's own
};

AccuracyRow rowOf(const Window& window, const WindowRun& run, const Reference& reference);

/// The order of convergence that a fixed stepper shows.
struct OrderRow {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    std::optional<double> order;  ///< nothing with fewer than three points
    std::size_t points = 0;       ///< number of runs that the order is fitted to
    double longest = 0.0;         ///< largest step of these runs, s
    double shortest = 0.0;        ///< smallest step of these runs, s
};

/// Fits each stepper's finest resolved runs, four at most, that rejected no step and err by at most 0.05 radii: larger
/// errors are not small beside the distances over which the forces change, so they do not show the order.
std::vector<OrderRow> ordersOf(const std::vector<AccuracyRow>& rows);

/// The fixed stepper that reaches some error at the least cost.
struct HandPicked {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double cost = 0.0;  ///< seconds or force evaluations
};

/// A run of the automatic stepper, compared with the best choice of a fixed stepper and step.
struct AutoRow {
    double asked = 0.0;     ///< error that was asked for, radii per second of motion
    double obtained = 0.0;  ///< error against the reference, radii per second of motion
    double seconds = 0.0;
    double evaluationCost = 0.0;  ///< see WindowRun
    bool resolved = false;
    /// The cheapest fixed stepper at the error that was obtained, and at the error that was asked for; nothing where no
    /// fixed run has so small an error.
    std::optional<HandPicked> secondsAtObtained, secondsAtAsked;
    std::optional<HandPicked> evaluationsAtObtained, evaluationsAtAsked;
};

/// A row for each finished run of the automatic stepper.
std::vector<AutoRow> autosOf(const std::vector<AccuracyRow>& rows, double windowSeconds);

/// The results for a scene.
struct SceneAccuracy {
    std::string name;               ///< the caller's name for the scene and window
    std::string title;              ///< of the scene
    std::size_t particleCount = 0;  ///< at the start of the window
    double from = 0.0;              ///< start of the window, s
    double window = 0.0;            ///< length of the window, s
    double productCost = 0.0;       ///< of a matrix-vector product of the implicit steppers, in force evaluations
    ReferenceFacts reference;
    std::vector<AccuracyRow> rows;
    std::vector<OrderRow> orders;
    std::vector<AutoRow> autos;
};

/// Runs the whole study of a scene.
/// @throws engine::InstabilityError if the scene does not reach the window, or no run finishes that could be refined
///         into a reference
SceneAccuracy measureAccuracy(const std::string& name, const scenes::Scene& scene, const AccuracySettings& settings,
                              const RunListener& listener);

// Tables as CSV with a header line. Column names end in the unit; a field without a value is empty.

std::string accuracyCsv(const std::vector<SceneAccuracy>& scenes);    ///< a line for each run
std::string ordersCsv(const std::vector<SceneAccuracy>& scenes);      ///< a line for each fixed stepper of each scene
std::string autosCsv(const std::vector<SceneAccuracy>& scenes);       ///< a line for each asked error of each scene
std::string referencesCsv(const std::vector<SceneAccuracy>& scenes);  ///< a line for each scene

enum class CostAxis {
    seconds,          ///< wall clock
    forceEvaluations  ///< WindowRun::evaluationCost
};

/// A gnuplot script for a work-precision diagram, error against cost on logarithmic axes, as SVG on standard output.
/// Only resolved runs are drawn; the key says how many runs of a stepper did not finish.
std::string accuracyPlot(const SceneAccuracy& scene, CostAxis axis);

}  // namespace studies
