// Validates scalars, and lists element by element, so that every wrong element is reported.
#include "scenes/schema/typed_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/text/color.h"
#include "scenes/text/edit_distance.h"

namespace scenes {
namespace {

using engine::Vec3;

/// A valid value; nothing if it was rejected, and its problems recorded.
using MaybeValue = std::optional<TypedValue>;

/// What is validated: a key's value or an element of it.
struct Subject {
    const Key& key;
    ProblemList& problems;
    std::string name;      ///< as messages call it: "gravity" or "gravity[1]"
    std::string expected;  ///< what it must be: "three numbers [x, y, z]"

    Subject element(std::size_t index, std::string elementExpected) const {
        return {key, problems, fmt::format("{}[{}]", name, index), std::move(elementExpected)};
    }
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

/// Whether the key's number, or each of its numbers, has to be an integer.
bool isInteger(const Key& key) {
    return key.type == Type::integer || key.type == Type::size || key.type == Type::counts;
}

/// A finite number within the key's range.
std::optional<double> numberOf(const Subject& subject, const Value& value) {
    const bool isNumber = value.kind == ValueKind::integer || value.kind == ValueKind::floatingPoint;
    if (isInteger(subject.key) ? value.kind != ValueKind::integer : !isNumber) return reject(subject, value);
    if (!std::isfinite(value.number)) return reject(subject, value.position, describe(value), "finite");
    if (!contains(subject.key.range, value.number))
        return reject(subject, value.position, describe(value), rangeText(subject.key.range));
    return value.number;
}

/// The numbers of an array of the given length.
std::optional<std::vector<double>> numbersOf(const Subject& subject, const Value& value, std::size_t length) {
    if (value.kind != ValueKind::array || value.items.size() != length) return reject(subject, value);
    const char* const expected = isInteger(subject.key) ? "a whole number" : "a number";
    std::vector<double> numbers;
    for (std::size_t index = 0; index < length; ++index)
        if (const auto number = numberOf(subject.element(index, expected), value.items[index]))
            numbers.push_back(*number);
    if (numbers.size() < length) return std::nullopt;
    return numbers;
}

MaybeValue scalarOf(const Subject& subject, const Value& value) {
    const auto number = numberOf(subject, value);
    if (!number) return std::nullopt;
    TypedValue typed = TypedValue::ofNumber(*number);
    typed.integer = value.integer;
    if (isInteger(subject.key)) typed.canonical = fmt::format("{}", value.integer);
    return typed;
}

MaybeValue numberListOf(const Subject& subject, const Value& value) {
    if (value.items.empty()) return reject(subject, value);
    auto numbers = numbersOf(subject, value, value.items.size());
    if (!numbers) return std::nullopt;
    return TypedValue::ofNumbers(std::move(*numbers));
}

MaybeValue pairOf(const Subject& subject, const Value& value) {
    auto numbers = numbersOf(subject, value, 2);
    if (!numbers) return std::nullopt;
    const bool isOrdered = (*numbers)[0] < (*numbers)[1];
    TypedValue typed = TypedValue::ofNumbers(std::move(*numbers));
    if (subject.key.type == Type::interval && !isOrdered)
        return reject(subject, value.position, typed.canonical, subject.expected);
    return typed;
}

MaybeValue vectorOf(const Subject& subject, const Value& value) {
    const auto numbers = numbersOf(subject, value, 3);
    if (!numbers) return std::nullopt;
    return TypedValue::ofVector(Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]));
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

/// A list of vectors or of colors.
MaybeValue vectorListOf(const Subject& subject, const Value& value) {
    if (value.kind != ValueKind::array || value.items.empty()) return reject(subject, value);
    const bool isColor = subject.key.type == Type::colorList;
    const Key elementKey{.type = isColor ? Type::color : Type::vec3};
    TypedValue typed;
    std::vector<std::string> texts;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const Subject element = subject.element(index, expectedText(elementKey));
        const MaybeValue vector = (isColor ? colorOf : vectorOf)(element, value.items[index]);
        if (!vector) continue;
        typed.vectors.push_back(vector->vectors[0]);
        texts.push_back(vector->canonical);
    }
    if (texts.size() < value.items.size()) return std::nullopt;
    typed.canonical = fmt::format("[{}]", fmt::join(texts, ", "));
    return typed;
}

MaybeValue choiceOf(const Subject& subject, const Value& value) {
    const std::vector<std::string> choices(subject.key.choices.begin(), subject.key.choices.end());
    if (value.kind != ValueKind::string) return reject(subject, value);
    if (std::find(choices.begin(), choices.end(), value.string) != choices.end())
        return TypedValue::ofString(value.string);
    const std::string nearest = nearestName(value.string, choices);
    const std::string hint = nearest.empty() ? "" : fmt::format(", did you mean {}?", tomlString(nearest));
    return reject(subject, value.position, tomlString(value.string), subject.expected + hint);
}

MaybeValue stringOf(const Subject& subject, const Value& value) {
    if (value.kind != ValueKind::string) return reject(subject, value);
    return TypedValue::ofString(value.string);
}

MaybeValue stringListOf(const Subject& subject, const Value& value) {
    if (value.kind != ValueKind::array) return reject(subject, value);
    TypedValue typed;
    std::vector<std::string> texts;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const MaybeValue string = stringOf(subject.element(index, "a string"), value.items[index]);
        if (!string) continue;
        typed.strings.push_back(string->string);
        texts.push_back(string->canonical);
    }
    if (texts.size() < value.items.size()) return std::nullopt;
    typed.canonical = fmt::format("[{}]", fmt::join(texts, ", "));
    return typed;
}

MaybeValue booleanOf(const Subject& subject, const Value& value) {
    if (value.kind != ValueKind::boolean) return reject(subject, value);
    return TypedValue::ofBoolean(value.boolean);
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
    const Subject subject{key, problems, std::string(key.name), expectedText(key)};
    if (value.kind == ValueKind::invalid) {
        // Its syntax error has been reported already, unless the file itself contains the reader's internal marker.
        if (problems.empty()) reject(subject, value);
        return std::nullopt;
    }
    switch (key.type) {
        case Type::number:
        case Type::integer:
            return scalarOf(subject, value);
        case Type::numberList:
            return numberListOf(subject, value);
        case Type::stringList:
            return stringListOf(subject, value);
        case Type::boolean:
            return booleanOf(subject, value);
        case Type::string:
            return stringOf(subject, value);
        case Type::choice:
            return choiceOf(subject, value);
        case Type::vec3:
        case Type::counts:
            return vectorOf(subject, value);
        case Type::color:
            return colorOf(subject, value);
        case Type::vec3List:
        case Type::colorList:
            return vectorListOf(subject, value);
        case Type::interval:
        case Type::size:
            return pairOf(subject, value);
    }
    return std::nullopt;
}

}  // namespace scenes
