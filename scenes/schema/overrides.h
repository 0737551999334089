// Overrides: changes to a scene file before it is checked, so that they pass through the same checks.
#pragma once

#include "scenes/text/located.h"
#include "scenes/text/override.h"
#include "scenes/text/problem_list.h"

namespace scenes {

/// Writes each override into the scene's root table. A value that is no TOML is taken as a string, so that
/// physics.stepper=symplectic-euler needs no quotes. Keys: title, physics.step, body[0].radius or body.0.radius.
void applyOverrides(Value& root, const Overrides& overrides, ProblemList& problems);

}  // namespace scenes
