// Scene text to located values, with every syntax error of the text found. Called by the scene reader and by the
// overrides.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scenes/text/located.h"
#include "scenes/text/problem_list.h"

namespace scenes {

struct Document {
    Value root;            ///< a table
    bool damaged = false;  ///< statements were left out, so a missing key may be one of them
};

/// The values of a TOML text. Syntax errors and duplicate keys are recorded, one for each statement, and the statement
/// is left out: its key reads as Kind::broken.
Document parseDocument(std::string_view text, ProblemList& problems);

/// A value written by an override, in TOML; anything that is no TOML value is taken as a string.
Value parseOverrideValue(const std::string& text, int overrideIndex);

}  // namespace scenes
