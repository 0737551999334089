// Validates a TOML value against its row of the schema: type, finiteness, range, choices. Called for every key of a
// scene, for every override and for every default.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/vec3.h"
#include "scenes/schema/schema.h"
#include "scenes/text/problem_list.h"

namespace scenes {

/// A valid value. The type of its key determines which members are set.
struct TypedValue {
    double number = 0.0;                ///< number
    std::int64_t integer = 0;           ///< integer
    bool boolean = false;               ///< boolean
    std::string string;                 ///< string, choice
    std::vector<std::string> strings;   ///< stringList
    std::vector<engine::Vec3> vectors;  ///< vec3, color and counts: one; vec3List and colorList: all
    std::vector<double> numbers;        ///< numberList: all; interval and size: two
    std::string canonical;              ///< TOML text, equal for values that mean the same

    static TypedValue ofNumber(double number);
    static TypedValue ofBoolean(bool boolean);
    static TypedValue ofString(std::string string);
    static TypedValue ofNumbers(std::vector<double> numbers);
    static TypedValue ofVector(const engine::Vec3& vector);
};

/// The value in the type of its key; nothing, with every problem recorded, if it is not valid.
std::optional<TypedValue> validateValue(const Key& key, const Value& value, ProblemList& problems);

}  // namespace scenes
