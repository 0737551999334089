// Validates the values of a scene: lists element by element, so that every wrong element is reported.
#include "scenes/schema/typed_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/text/color.h"
#include "scenes/text/edit_distance.h"
#include "scenes/text/frame_rate.h"

namespace scenes {
namespace {

using engine::Vec3;

/// The result of validating a value: the valid value, or nothing if it was rejected with its problems recorded.
using MaybeValue = std::optional<TypedValue>;

/// A value that is being validated: the value of a key, or an element of it.
struct Subject {
    const Key& key;  ///< the key; for an element of a list, with its type changed to that of the element
    ProblemList& problems;
    std::string name;                          ///< what messages call the value: "gravity" or "gravity[1]"
    std::string expected = expectedText(key);  ///< what the value must be: "three numbers [x, y, z]"
};

std::nullopt_t reject(const Subject& subject, const SourcePosition& position, const std::string& found,
                      const std::string& expected) {
    const std::string_view unit = subject.key.unit;
    subject.problems.add(position, fmt::format("{} is {}, must be {}{}", subject.name, found, expected,
                                               unit.empty() ? "" : fmt::format(" ({})", unitWords(unit))));
    return std::nullopt;
}

std::nullopt_t reject(const Subject& subject, const Value& value) {
    return reject(subject, value.position, describe(value), subject.expected);
}

bool contains(const Range& range, double number) {
    return (range.isLowExcluded ? number > range.low : number >= range.low) &&
           (range.isHighExcluded ? number < range.high : number <= range.high);
}

/// Validates the value as a finite number within the range of the key.
MaybeValue numberOf(const Subject& subject, const Value& value) {
    const bool isInteger = value.kind == ValueKind::integer;
    const bool isNumber = isInteger || value.kind == ValueKind::floatingPoint;
    if (subject.key.type == Type::integer ? !isInteger : !isNumber) return reject(subject, value);
    if (!std::isfinite(value.number)) return reject(subject, value.position, describe(value), "finite");
    if (!contains(subject.key.range, value.number))
        return reject(subject, value.position, describe(value), rangeText(subject.key.range));
    TypedValue typed = TypedValue::ofNumber(value.number);
    typed.integer = value.integer;
    if (subject.key.type == Type::integer) typed.canonical = fmt::format("{}", value.integer);
    return typed;
}

/// Validates the value as a whole number, or as a string with a fraction, within the range of the key.
MaybeValue frameRateOf(const Subject& subject, const Value& value) {
    const bool isInteger = value.kind == ValueKind::integer;
    const bool isFraction = value.kind == ValueKind::string && value.string.find('/') != std::string::npos;
    if (!isInteger && !isFraction) return reject(subject, value);
    const auto rate = frameRateFrom(isInteger ? fmt::to_string(value.integer) : value.string);
    if (!rate && isFraction) return reject(subject, value);
    if (!rate || !contains(subject.key.range, rate->framesIn(1.0)))
        return reject(subject, value.position, describe(value), rangeText(subject.key.range));
    TypedValue typed;
    typed.frameRate = *rate;
    // A fraction that is a whole number means the same as that number.
    typed.canonical = rate->denominator == 1 ? rate->text() : tomlString(rate->text());
    return typed;
}

MaybeValue choiceOf(const Subject& subject, const Value& value) {
    const std::vector<std::string> choices(subject.key.choices.begin(), subject.key.choices.end());
    if (value.kind != ValueKind::string) return reject(subject, value);
    if (std::ranges::count(choices, value.string) > 0) return TypedValue::ofString(value.string);
    const std::string nearest = nearestName(value.string, choices);
    const std::string hint = nearest.empty() ? "" : fmt::format(", did you mean {}?", tomlString(nearest));
    return reject(subject, value.position, tomlString(value.string), subject.expected + hint);
}

MaybeValue typedOf(const Subject& subject, const Value& value);

/// Validates the value as a list whose elements are of the given type.
MaybeValue listOf(const Subject& subject, const Value& value, Type elementType) {
    const bool mayBeEmpty = elementType == Type::string;
    if (value.kind != ValueKind::array || (value.items.empty() && !mayBeEmpty)) return reject(subject, value);
    Key elementKey = subject.key;
    elementKey.type = elementType;
    TypedValue list;
    std::vector<std::string> texts;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const Subject element{elementKey, subject.problems, fmt::format("{}[{}]", subject.name, index)};
        const MaybeValue typed = typedOf(element, value.items[index]);
        if (!typed) continue;
        list.numbers.push_back(typed->number);
        list.strings.push_back(typed->string);
        list.vectors.insert(list.vectors.end(), typed->vectors.begin(), typed->vectors.end());
        texts.push_back(typed->canonical);
    }
    if (texts.size() < value.items.size()) return std::nullopt;
    list.canonical = fmt::format("[{}]", fmt::join(texts, ", "));
    return list;
}

/// Validates the value as a list of numbers of the given length.
MaybeValue numbersOf(const Subject& subject, const Value& value, std::size_t length, Type elementType) {
    if (value.kind != ValueKind::array || value.items.size() != length) return reject(subject, value);
    return listOf(subject, value, elementType);
}

MaybeValue pairsOf(const Subject& subject, const Value& value) {
    if (value.kind != ValueKind::array || value.items.empty()) return reject(subject, value);
    TypedValue pairs;
    std::vector<std::string> texts;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const Subject element{subject.key, subject.problems, fmt::format("{}[{}]", subject.name, index),
                              "two numbers [radius, height]"};
        const MaybeValue pair = numbersOf(element, value.items[index], 2, Type::number);
        if (!pair) continue;
        pairs.numbers.insert(pairs.numbers.end(), pair->numbers.begin(), pair->numbers.end());
        texts.push_back(pair->canonical);
    }
    if (texts.size() < value.items.size()) return std::nullopt;
    pairs.canonical = fmt::format("[{}]", fmt::join(texts, ", "));
    return pairs;
}

MaybeValue intervalOf(const Subject& subject, const Value& value) {
    const MaybeValue pair = numbersOf(subject, value, 2, Type::number);
    if (pair && pair->numbers[0] >= pair->numbers[1])
        return reject(subject, value.position, pair->canonical, subject.expected);
    return pair;
}

MaybeValue vectorOf(const Subject& subject, const Value& value, Type elementType = Type::number) {
    const MaybeValue list = numbersOf(subject, value, 3, elementType);
    if (!list) return std::nullopt;
    return TypedValue::ofVector(Vec3(list->numbers[0], list->numbers[1], list->numbers[2]));
}

MaybeValue colorOf(const Subject& subject, const Value& value) {
    if (value.kind == ValueKind::array) return vectorOf(subject, value);
    const auto color = value.kind == ValueKind::string ? colorFromHex(value.string) : std::nullopt;
    if (!color) return reject(subject, value);
    std::string lowerCase = value.string;
    for (char& c : lowerCase)
        if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
    TypedValue typed;
    typed.vectors = {*color};
    typed.canonical = tomlString(lowerCase);
    return typed;
}

MaybeValue typedOf(const Subject& subject, const Value& value) {
    switch (subject.key.type) {
        case Type::number:
        case Type::integer:
            return numberOf(subject, value);
        case Type::frameRate:
            return frameRateOf(subject, value);
        case Type::boolean:
            if (value.kind == ValueKind::boolean) return TypedValue::ofBoolean(value.boolean);
            break;
        case Type::string:
            if (value.kind == ValueKind::string) return TypedValue::ofString(value.string);
            break;
        case Type::choice:
            return choiceOf(subject, value);
        case Type::vec3:
            return vectorOf(subject, value);
        case Type::counts:
            return vectorOf(subject, value, Type::integer);
        case Type::color:
            return colorOf(subject, value);
        case Type::pairList:
            return pairsOf(subject, value);
        case Type::interval:
            return intervalOf(subject, value);
        case Type::size:
            return numbersOf(subject, value, 2, Type::integer);
        case Type::numberList:
            return listOf(subject, value, Type::number);
        case Type::stringList:
            return listOf(subject, value, Type::string);
        case Type::vec3List:
            return listOf(subject, value, Type::vec3);
        case Type::colorList:
            return listOf(subject, value, Type::color);
    }
    return reject(subject, value);
}

}  // namespace

TypedValue TypedValue::ofNumber(double number) {
    TypedValue value;
    value.number = number;
    value.canonical = formatNumber(number);
    return value;
}

TypedValue TypedValue::ofBoolean(bool boolean) {
    TypedValue value;
    value.boolean = boolean;
    value.canonical = boolean ? "true" : "false";
    return value;
}

TypedValue TypedValue::ofString(std::string string) {
    TypedValue value;
    value.canonical = tomlString(string);
    value.string = std::move(string);
    return value;
}

TypedValue TypedValue::ofNumbers(std::vector<double> numbers) {
    TypedValue value;
    std::vector<std::string> texts;
    for (const double number : numbers) texts.push_back(formatNumber(number));
    value.canonical = fmt::format("[{}]", fmt::join(texts, ", "));
    value.numbers = std::move(numbers);
    return value;
}

TypedValue TypedValue::ofVector(const Vec3& vector) {
    TypedValue value = ofNumbers({vector.x(), vector.y(), vector.z()});
    value.numbers.clear();
    value.vectors = {vector};
    return value;
}

std::optional<TypedValue> validateValue(const Key& key, const Value& value, ProblemList& problems) {
    const Subject subject{key, problems, std::string(key.name)};
    if (value.kind == ValueKind::invalid) {
        // The syntax error in the value has been reported already, unless the file itself contains the marker that
        // replaces such values.
        if (problems.empty()) reject(subject, value);
        return std::nullopt;
    }
    return typedOf(subject, value);
}

}  // namespace scenes
