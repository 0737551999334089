// The error of a run, estimated by step doubling: the same interval is run with its step and with half of it. Called by
// the automatic stepper to choose, and by the loops over frames to report.
#pragma once

#include <limits>
#include <optional>

#include "engine/state/simulation.h"

namespace engine {

/// How long a wrong velocity goes on to displace a particle, until damping or a collision has removed it, s.
/// Measured: with it the estimate is within a factor of two of the error against a reference on liquid, solid, fountain
/// and honey (`globular study accuracy`).
inline constexpr double kErrorHorizon = 0.0125;

/// What is to be run for an error estimate.
struct TrialRun {
    double time = 0.0;  ///< at which it ends, s
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.0;               ///< longest, s
    double horizon = kErrorHorizon;  ///< how long a wrong velocity counts, s
    double mostEvaluations =
        std::numeric_limits<double>::infinity();  ///< force evaluations after which the first run is given up
};

/// What a trial run showed.
struct Trial {
    StepperKind stepper = StepperKind::velocityVerlet;
    bool finished = true;             ///< whether the first run got to the end; otherwise only `spent` is known
    double asked = 0.0;               ///< longest step it was allowed to take, s
    double step = 0.0;                ///< mean step it took, s; emissions and the audit shorten steps
    double error = 0.0;               ///< at that mean step, radii per second of motion
    double cost = 0.0;                ///< at that mean step, force evaluations per second of motion
    double spent = 0.0;               ///< force evaluations of both runs
    bool restricted = false;          ///< whether the audit kept it from the step it was allowed
    std::optional<StepLimit> reason;  ///< why the audit did
};

/// Measures a stepper from the present state to a time. The error is the RMS over the particles of dx + T dv, in radii,
/// divided by the interval; dx and dv are the changes at the end that half the step makes, and T is the horizon. By
/// Richardson's argument a run of order p with steps h errs by its difference to a run with steps h', divided by 1 -
/// (h'/h)^p.
/// @param finer  if given, receives the simulation as the finer of the two runs left it
/// @throws InstabilityError
Trial measure(const Simulation& simulation, const TrialRun& trialRun, Simulation* finer = nullptr);

/// Steps that are 1.5 times shorter should err 2.2 times less. Where the error stays above this share, it has another
/// cause than the step, for example a swept contact, and shorter steps are wasted.
inline constexpr double kWasted = 0.7;

/// The step (s) at which the error would be the wanted one (radii per second), as far as a measurement reaches.
double wantedStep(const Trial& trial, double wanted);

/// Ratio of a step (s) of the same stepper to the step that was measured.
double stepRatioTo(const Trial& trial, double step);

/// Cost of steps that may be as long as `step` (s), force evaluations per second of motion. Emissions end as many steps
/// early with longer steps as with shorter ones.
double costAt(const Trial& trial, double step);

}  // namespace engine
