// Validates a TOML value against the key of the schema that it is given for: type, finiteness, range, choices. Called
// for every key of a scene, every override and every default.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/vec3.h"
#include "render/picture/view.h"
#include "scenes/schema/schema.h"
#include "scenes/text/problem_list.h"

namespace scenes {

/// A valid value of a key. The type of the key determines which members hold it.
struct TypedValue {
    double number = 0.0;                ///< number
    std::int64_t integer = 0;           ///< integer
    render::FrameRate frameRate;        ///< frameRate
    bool boolean = false;               ///< boolean
    std::string string;                 ///< string, choice
    std::vector<std::string> strings;   ///< stringList
    std::vector<engine::Vec3> vectors;  ///< the value of a vec3, color or counts; elements of a vec3List or colorList
    std::vector<double> numbers;        ///< elements of an interval, size or numberList; of a pairList, pair by pair
    std::string canonical;              ///< the value as TOML text, equal for values that mean the same

    static TypedValue ofNumber(double number);
    static TypedValue ofBoolean(bool boolean);
    static TypedValue ofString(std::string string);
    static TypedValue ofNumbers(std::vector<double> numbers);
    static TypedValue ofVector(const engine::Vec3& vector);
};

/// Validates the value of a key. Returns nothing, with every problem recorded, if the value is not valid.
std::optional<TypedValue> validateValue(const Key& key, const Value& value, ProblemList& problems);

}  // namespace scenes
