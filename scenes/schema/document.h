// Parses the text of a scene into TOML values, with every syntax error of the text found, and applies overrides.
#pragma once

#include <string>
#include <string_view>

#include "scenes/text/problem_list.h"
#include "scenes/text/value.h"

namespace scenes {

struct Document {
    Value root;                 ///< a table
    bool hasOmissions = false;  ///< statements had to be left out, and a missing key may be in one of them
};

/// Parses a TOML text. Syntax errors and duplicate keys are recorded, at most one for each statement. A key whose value
/// cannot be parsed gets a value of kind ValueKind::invalid.
Document parseDocument(std::string_view text, ProblemList& problems);

/// Parses the value of an override. Text that is not a TOML value is taken as a string, so that
/// physics.stepper=symplectic-euler needs no quotes.
Value parseOverrideValue(const std::string& text, int overrideIndex);

/// Writes each override into the scene's root table, before the scene is validated, so that overrides go through the
/// same checks as the file. Keys are written title, physics.step, body[0].radius or body.0.radius.
void applyOverrides(Value& root, const Overrides& overrides, ProblemList& problems);

}  // namespace scenes
