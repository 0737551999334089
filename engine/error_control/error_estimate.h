// How far off a run is, measured instead of promised: the same interval is run with its step and with half of it.
// Called by the automatic stepper to choose, and by the loops over frames to report.
#pragma once

#include <limits>
#include <optional>

#include "engine/state/simulation.h"

namespace engine {

/// A wrong velocity goes on to move a particle wrongly until damping or a collision has eaten it, after this time, s.
/// Measured: with it the estimate is within a factor of two of the error against a reference on liquid, solid, fountain
/// and honey (`globular study accuracy`).
inline constexpr double kErrorHorizon = 0.0125;

/// What is to be measured.
struct Look {
    double time = 0.0;  ///< where it ends, s
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.0;                                            ///< longest, s
    double horizon = kErrorHorizon;                               ///< how long a wrong velocity counts, s
    double mostPasses = std::numeric_limits<double>::infinity();  ///< of the first run; given up beyond
};

/// One way over an interval, with what it cost.
struct Trial {
    StepperKind stepper = StepperKind::velocityVerlet;
    bool finished = true;             ///< otherwise only `spent` is known
    double asked = 0.0;               ///< longest step it could take, s
    double step = 0.0;                ///< mean length of the steps it took, s: births and the audit shorten them
    double error = 0.0;               ///< of these steps, radii per second of motion
    double cost = 0.0;                ///< of these steps, passes over all pairs for a second of motion
    double spent = 0.0;               ///< on both runs of the measurement, passes over all pairs
    bool restricted = false;          ///< the audit kept it from the step it was asked for
    std::optional<StepLimit> reason;  ///< why
};

/// Measures a stepper on the way from the present state to a time.
/// Shape:  the error is the rms over the particles of dx + T dv, in radii, divided by the interval: dx and dv are what
///         half the step changes at the end, T is the look's horizon.
/// Source: Richardson: with order p, a run of steps h errs by the difference to one of steps h' divided by
///         1 - (h'/h)^p.
/// `finer`, if given, receives the simulation at the end as the finer of the two runs left it.
/// Throws: InstabilityError.
Trial measure(const Simulation& simulation, const Look& look, Simulation* finer = nullptr);

/// Steps at least 1.5 times shorter should err 2.2 times less. Where they err more than this share, something else than
/// the step makes the error, such as the sweep past an obstacle, and shorter ones are wasted.
inline constexpr double kWasted = 0.7;

/// The step (s) at which the error would be the wanted one (radii per second), as far as a measurement reaches.
double wantedStep(const Trial& trial, double wanted);

/// What a step (s) of the same stepper is to those that were measured.
double shareOf(const Trial& trial, double step);

/// What steps that may be so long (s) cost, passes over all pairs for a second of motion. Those that births end early
/// are as many with longer ones.
double costAt(const Trial& trial, double step);

}  // namespace engine
