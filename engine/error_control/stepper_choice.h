// Which stepper the automatic stepper takes. Another one is tried by a twin (twin.h) and taken if it costs less at the
// wanted error.
#pragma once

#include "engine/error_control/twin.h"

namespace engine {

/// Whether the automatic stepper may choose a stepper.
bool isCandidate(StepperKind stepper);

/// Whether steps that the error does not limit cost enough that another stepper may be worth a trial.
/// @param interval  length of an interval, s
bool areManySteps(const AutoState& state, double interval);

/// Whether the next twin is to be of another stepper. Velocity Verlet is left only where something else than the error
/// limits its steps.
bool isCandidateDue(const Simulation& simulation, double interval);

/// Sends another stepper ahead, and plans the next one.
void sendNextCandidate(Simulation& simulation, double interval);

/// Takes the stepper of the twin if it costs less at the step with which it meets the wanted error.
void judgeCandidate(Simulation& simulation, const Comparison& compared, double interval);

}  // namespace engine
