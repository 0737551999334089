// How far off a run is, measured instead of promised: the same interval is run with its step and with half of it.
// Called by the automatic stepper to choose, and by the loops over frames to report.
#pragma once

#include <optional>

#include "engine/simulation.h"

namespace engine {

/// What an implicit step pays for its matrix and for a product with it, in passes over all pairs. Measured: the seconds
/// of steps of liquid, solid and honey against their counts in `globular study accuracy`.
inline constexpr double kMatrixCost = 0.3;
inline constexpr double kProductCost = 0.27;

/// A wrong velocity goes on to move a particle wrongly until damping or a collision has eaten it, after this time, s.
/// Measured: with it the estimate is within a factor of two of the error against a reference on liquid, solid, fountain
/// and honey (`globular study accuracy`).
inline constexpr double kErrorHorizon = 0.0125;

/// What steps cost, in passes over all pairs.
double passesOf(const StepStatistics& steps);

/// One way over an interval, with what it cost.
struct Trial {
    StepperKind stepper = StepperKind::velocityVerlet;
    double asked = 0.0;               ///< longest step it could take, s
    double step = 0.0;                ///< mean length of the steps it took, s: births and the audit shorten them
    double error = 0.0;               ///< of these steps, radii per second of motion
    double cost = 0.0;                ///< of these steps, passes over all pairs for a second of motion
    double spent = 0.0;               ///< on both runs of the measurement, passes over all pairs
    bool restricted = false;          ///< the audit kept it from the step it was asked for
    std::optional<StepLimit> reason;  ///< why
};

/// Measures a stepper on the way from the present state to a time (s).
/// Shape:  the error is the rms over the particles of dx + T dv, in radii, divided by the interval: dx and dv are what
///         half the step changes at the end, T is kErrorHorizon.
/// Source: Richardson: with order p, a run of steps h errs by the difference to one of steps h' divided by
///         1 - (h'/h)^p.
/// `finer`, if given, receives the simulation at the end as the finer of the two runs left it.
/// Throws: InstabilityError.
Trial measure(const Simulation& simulation, double time, StepperKind stepper, double step, Simulation* finer = nullptr);

}  // namespace engine
