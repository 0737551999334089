// One written value against its row of the schema: type, finiteness, bounds, choices. Called for every key of a scene,
// for every override and for every default.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/vec3.h"
#include "scenes/schema/schema.h"
#include "scenes/text/problem_list.h"

namespace scenes {

/// A value that fits its key. Which member counts follows from the key's type.
struct Typed {
    double number = 0.0;                ///< number
    std::int64_t integer = 0;           ///< integer
    bool flag = false;                  ///< boolean
    std::string text;                   ///< text, choice
    std::vector<std::string> texts;     ///< textList
    std::vector<engine::Vec3> vectors;  ///< vec3 and color: one; vec3List and colorList: all; counts: one
    std::vector<double> numbers;        ///< numberList: all; interval, size: two
    std::string canonical;              ///< TOML text; equal for values that mean the same
};

/// The value as the key wants it; nothing, with every problem recorded, if it does not fit.
std::optional<Typed> checkValue(const Key& key, const Value& value, ProblemList& problems);

}  // namespace scenes
