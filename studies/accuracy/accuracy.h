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
    int firstFrame = 0;                                           ///< frame at which the window begins
    int frameCount = 15;                                          ///< length of the window, frames
    std::vector<int> stepsPerFrame = {1, 2, 4, 8, 16, 32, 64};    ///< steps per frame of the fixed steppers, rising
    std::vector<double> errors = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3};  ///< errors asked of the automatic stepper, radii/s
    int rounds = 3;                  ///< how often a run is timed; long runs are timed fewer times, short ones more
    double runLimit = 60.0;          ///< wall-clock limit of a run, s; a longer run is given up as too slow
    double referenceBudget = 180.0;  ///< wall-clock limit of all runs of the reference together, s
};

/// One run compared with the reference at the end of the window.
struct AccuracyRow {
    WindowRun run;                ///< the run, without the particles at its end
    double rms = 0.0;             ///< root mean square position error, radii
    double largest = 0.0;         ///< largest position error of a particle, radii
    std::size_t compared = 0;     ///< number of particles in the position errors
    double statistics = 0.0;      ///< error of the bulk statistics of all particles, radii
    double error = 0.0;           ///< rms or statistics, whichever the reference run is compared by, radii
    double errorPerSecond = 0.0;  ///< error divided by the length of the window, radii/s
    /// Difference of the energy from that of the reference run, divided by the sum of the reference's kinetic energy
    /// and the magnitudes of its pair and contact energies.
    double energyDrift = 0.0;
    double linearDrift = 0.0;   ///< difference from the reference's momentum, over its sum of |p|
    double angularDrift = 0.0;  ///< difference from the reference's angular momentum, over its sum of |x x p|
    bool resolved = false;      ///< whether the run finished with an error well above that of the reference
};

/// Compares a run with the reference run. Of an unfinished run only the run itself is set.
AccuracyRow rowOf(const Window& window, const WindowRun& run, const Reference& reference);

/// The order of convergence that a fixed stepper shows.
struct OrderRow {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    std::optional<double> order;  ///< the fitted order; nothing with fewer than three runs
    std::size_t points = 0;       ///< number of runs that the order is fitted to
    double longest = 0.0;         ///< largest step of the runs that the order is fitted to, s
    double shortest = 0.0;        ///< smallest step of the runs that the order is fitted to, s
};

/// The order of convergence of each fixed stepper, fitted to its runs with the smallest steps. At most four runs count,
/// which must be resolved, have rejected no step and err by at most 0.05 radii: larger errors are not small beside the
/// distances over which the forces change, so they do not show the order.
std::vector<OrderRow> ordersOf(const std::vector<AccuracyRow>& rows);

/// The fixed stepper that reaches a given error at the least cost.
struct HandPicked {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double cost = 0.0;  ///< cost at the given error, s or force evaluations
};

/// A run of the automatic stepper, compared with the best choice of a fixed stepper and step.
struct AutoRow {
    double asked = 0.0;           ///< error that was asked for, radii per second of motion
    double obtained = 0.0;        ///< error against the reference, radii per second of motion
    double seconds = 0.0;         ///< wall-clock time of the run
    double evaluationCost = 0.0;  ///< work of the run, in force evaluations
    bool resolved = false;        ///< whether the error is well above that of the reference
    /// The fixed stepper with the least cost at the error that was obtained, and at the error that was asked for. There
    /// is none if no run of a fixed stepper has so small an error.
    std::optional<HandPicked> secondsAtObtained, secondsAtAsked;
    std::optional<HandPicked> evaluationsAtObtained, evaluationsAtAsked;
};

/// A row for each finished run of the automatic stepper.
std::vector<AutoRow> autosOf(const std::vector<AccuracyRow>& rows, double windowSeconds);

/// The results of the study for one scene.
struct SceneAccuracy {
    std::string name;               ///< name of the scene and window in tables and files
    std::string title;              ///< title of the scene
    std::size_t particleCount = 0;  ///< number of particles at the start of the window
    double from = 0.0;              ///< scene time at which the window begins, s
    double window = 0.0;            ///< length of the window, s
    double productCost = 0.0;       ///< cost of a matrix-vector product, in force evaluations
    ReferenceFacts reference;
    std::vector<AccuracyRow> rows;
    std::vector<OrderRow> orders;
    std::vector<AutoRow> autos;
};

/// Runs the whole study of a scene.
/// @throws engine::InstabilityError if the scene does not reach the window, or too few runs finish to find a reference
SceneAccuracy measureAccuracy(const std::string& name, const scenes::Scene& scene, const AccuracySettings& settings,
                              const RunListener& listener);

// The tables of the study as CSV with a header line. Column names end in the unit; a field without a value is empty.

/// CSV with a line for each run of each scene.
std::string accuracyCsv(const std::vector<SceneAccuracy>& scenes);
/// CSV with a line for each fixed stepper of each scene.
std::string ordersCsv(const std::vector<SceneAccuracy>& scenes);
/// CSV with a line for each run of the automatic stepper in each scene.
std::string autosCsv(const std::vector<SceneAccuracy>& scenes);
/// CSV with a line for the reference run of each scene.
std::string referencesCsv(const std::vector<SceneAccuracy>& scenes);

enum class CostAxis {
    seconds,          ///< wall-clock time of a run
    forceEvaluations  ///< work of a run, in force evaluations
};

/// A gnuplot script for a work-precision diagram: the error of the resolved runs against their cost, on logarithmic
/// axes, as SVG on standard output. The key says how many runs of a stepper did not finish.
std::string accuracyPlot(const SceneAccuracy& scene, CostAxis axis);

}  // namespace studies
