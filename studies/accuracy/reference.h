// The reference run that all other runs of a window are compared with, and the metric of the comparison: positions, or
// bulk statistics once the motion has become chaotic.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "studies/accuracy/window_run.h"

namespace studies {

/// How the states at the end of two runs are compared.
enum class ErrorMetric {
    positions,  ///< root mean square distance between corresponding particles, radii
    statistics  ///< largest difference of center of mass, radius of gyration, R90 and z90, mean radii
};

std::string_view nameOf(ErrorMetric metric);

/// The difference of two states at the end of the window by the given metric, radii.
double difference(const Window& window, ErrorMetric metric, const engine::Particles& a, const engine::Particles& b);

/// The largest difference of center of mass, radius of gyration, R90 and z90, in mean radii of the particles.
double statisticsDifference(const engine::Particles& particles, const engine::Particles& reference);

/// How the reference run was made and how good it is.
struct ReferenceFacts {
    Variant variant;                              ///< stepper and step of the reference run
    ErrorMetric metric = ErrorMetric::positions;  ///< how all runs are compared with the reference
    double change = 0.0;                          ///< change of the result by the last halving of the step, radii
    double twinSeparation = 0.0;  ///< distance at the end of two runs that began 1e-9 radii apart, radii
    double resolution = 0.0;      ///< smallest error that can be told from the reference's own, radii
    bool birthsDiffer = false;    ///< whether times of births depend on the step even in the finest runs
    bool settled = false;         ///< whether the last halving changed less than 1/20 of the smallest error
    double seconds = 0.0;         ///< wall-clock time of the finest run of the reference
};

struct Reference {
    WindowRun run;
    ReferenceFacts facts;
};

/// Called after every run with the purpose of the run: "run", "again" (to time it once more), "twin" or "reference".
using RunListener = std::function<void(const WindowRun&, std::string_view purpose)>;

/// Finds the reference run by refining the better of velocity Verlet and implicit damping: the step is halved until the
/// result changes by no more than a twentieth of the smallest error among the measured runs, or until the budget is
/// spent.
/// @param runs  the measured runs of all steppers, those of each stepper in the order of falling steps
/// @param budget  wall-clock limit of all reference runs together, s; at least two are made
/// @throws engine::InstabilityError if neither stepper finished two of the runs
Reference findReference(const Window& window, const std::vector<WindowRun>& runs, double budget,
                        const RunListener& listener);

}  // namespace studies
