// Checks of scalars first, then of lists made of them. Each records what was found and what was expected.
#include "scenes/schema/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/text/color.h"
#include "scenes/text/edit_distance.h"

namespace scenes {
namespace {

using engine::Vec3;

/// What is being checked, and where problems go.
struct Check {
    const Key& key;
    ProblemList& problems;
};

std::string inUnit(const Key& key) {
    return key.unit.empty() ? std::string{} : fmt::format(" ({})", unitWords(key.unit));
}

bool isNumber(const Value& value) {
    return value.kind == Kind::integer || value.kind == Kind::real;
}

void reportType(const Check& check, const Value& value) {
    check.problems.add(value.at, fmt::format("{} is {}, must be {}{}", nameOf(check.key), describe(value),
                                             expectedText(check.key), inUnit(check.key)));
}

bool isWithin(const Range& range, double number) {
    return (range.lowOpen ? number > range.low : number >= range.low) &&
           (range.highOpen ? number < range.high : number <= range.high);
}

/// A finite number within the key's bounds; named like `gravity[1]` in messages.
bool isFit(const Check& check, const Value& value, const std::string& name) {
    if (!std::isfinite(value.real)) {
        check.problems.add(value.at,
                           fmt::format("{} is {}, must be finite{}", name, describe(value), inUnit(check.key)));
        return false;
    }
    if (isWithin(check.key.range, value.real)) return true;
    check.problems.add(value.at, fmt::format("{} is {}, must be {}{}", name, describe(value),
                                             rangeText(check.key.range), inUnit(check.key)));
    return false;
}

/// What the numbers of a list have to be.
struct ListForm {
    std::size_t length = 0;
    bool whole = false;
};

/// The numbers of a list of fixed length; nothing, with all problems of its elements recorded, if any does not fit.
std::optional<std::vector<double>> numbersOf(const Check& check, const Value& value, const std::string& name,
                                             ListForm form) {
    const auto isElement = [&](const Value& item) { return form.whole ? item.kind == Kind::integer : isNumber(item); };
    if (value.kind != Kind::array || value.items.size() != form.length) {
        check.problems.add(value.at, fmt::format("{} is {}, must be {}{}", name, describe(value),
                                                 expectedText(check.key), inUnit(check.key)));
        return std::nullopt;
    }
    std::vector<double> numbers;
    bool fits = true;
    for (std::size_t index = 0; index < form.length; ++index) {
        const Value& item = value.items[index];
        const std::string itemName = fmt::format("{}[{}]", name, index);
        if (!isElement(item)) {
            check.problems.add(item.at, fmt::format("{} is {}, must be a {}number{}", itemName, describe(item),
                                                    form.whole ? "whole " : "", inUnit(check.key)));
            fits = false;
        } else {
            fits = isFit(check, item, itemName) && fits;
        }
        numbers.push_back(item.real);
    }
    if (!fits) return std::nullopt;
    return numbers;
}

std::string listText(const std::vector<double>& numbers) {
    std::vector<std::string> texts;
    for (const double number : numbers) texts.push_back(numberText(number));
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// A vector or color and its canonical text.
struct TextedVector {
    Vec3 vector = Vec3::Zero();
    std::string text;
};

std::optional<TextedVector> vectorOf(const Check& check, const Value& value, const std::string& name) {
    const auto numbers = numbersOf(check, value, name, {3, check.key.type == Type::counts});
    if (!numbers) return std::nullopt;
    return TextedVector{Vec3((*numbers)[0], (*numbers)[1], (*numbers)[2]), listText(*numbers)};
}

std::string lowerCase(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'F') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

std::optional<TextedVector> colorOf(const Check& check, const Value& value, const std::string& name) {
    if (value.kind == Kind::array) return vectorOf(check, value, name);
    const auto color = value.kind == Kind::text ? colorFromHex(value.text) : std::nullopt;
    if (color) return TextedVector{*color, inQuotes(lowerCase(value.text))};
    check.problems.add(value.at, fmt::format("{} is {}, must be \"#rrggbb\" or [r, g, b]", name, describe(value)));
    return std::nullopt;
}

std::optional<TextedVector> elementOf(const Check& check, const Value& value, const std::string& name) {
    const bool isColor = check.key.type == Type::color || check.key.type == Type::colorList;
    if (isColor) return colorOf(check, value, name);
    if (value.kind == Kind::array && value.items.size() == 3) return vectorOf(check, value, name);
    check.problems.add(
        value.at, fmt::format("{} is {}, must be three numbers [x, y, z]{}", name, describe(value), inUnit(check.key)));
    return std::nullopt;
}

std::optional<Typed> vectorListOf(const Check& check, const Value& value) {
    if (value.kind != Kind::array || value.items.empty()) {
        reportType(check, value);
        return std::nullopt;
    }
    Typed typed;
    bool fits = true;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const auto element = elementOf(check, value.items[index], fmt::format("{}[{}]", nameOf(check.key), index));
        fits = fits && element.has_value();
        if (!element) continue;
        typed.vectors.push_back(element->vector);
        typed.canonical += (index == 0 ? "[" : ", ") + element->text;
    }
    if (!fits) return std::nullopt;
    typed.canonical += ']';
    return typed;
}

std::optional<Typed> singleVectorOf(const Check& check, const Value& value) {
    const std::string name(nameOf(check.key));
    const auto element = check.key.type == Type::color ? colorOf(check, value, name) : vectorOf(check, value, name);
    if (!element) return std::nullopt;
    Typed typed;
    typed.vectors = {element->vector};
    typed.canonical = element->text;
    return typed;
}

std::optional<Typed> pairOf(const Check& check, const Value& value) {
    const auto numbers = numbersOf(check, value, std::string(nameOf(check.key)), {2, check.key.type == Type::size});
    if (!numbers) return std::nullopt;
    if (check.key.type == Type::interval && !((*numbers)[0] < (*numbers)[1])) {
        check.problems.add(value.at, fmt::format("{} is {}, must be {}{}", nameOf(check.key), listText(*numbers),
                                                 expectedText(check.key), inUnit(check.key)));
        return std::nullopt;
    }
    Typed typed;
    typed.numbers = *numbers;
    typed.canonical = listText(*numbers);
    return typed;
}

std::optional<Typed> numberOf(const Check& check, const Value& value) {
    const bool whole = check.key.type == Type::integer;
    if (whole ? value.kind != Kind::integer : !isNumber(value)) {
        reportType(check, value);
        return std::nullopt;
    }
    if (!isFit(check, value, std::string(nameOf(check.key)))) return std::nullopt;
    Typed typed;
    typed.number = value.real;
    typed.integer = value.integer;
    typed.canonical = whole ? fmt::format("{}", value.integer) : numberText(value.real);
    return typed;
}

std::optional<Typed> numberListOf(const Check& check, const Value& value) {
    if (value.kind != Kind::array || value.items.empty()) {
        reportType(check, value);
        return std::nullopt;
    }
    const auto numbers = numbersOf(check, value, std::string(nameOf(check.key)), {value.items.size(), false});
    if (!numbers) return std::nullopt;
    Typed typed;
    typed.numbers = *numbers;
    typed.canonical = listText(*numbers);
    return typed;
}

std::optional<Typed> choiceOf(const Check& check, const Value& value) {
    const std::vector<std::string> choices(check.key.choices.begin(), check.key.choices.end());
    if (value.kind == Kind::text && std::find(choices.begin(), choices.end(), value.text) != choices.end()) {
        Typed typed;
        typed.text = value.text;
        typed.canonical = inQuotes(value.text);
        return typed;
    }
    const std::string nearest = value.kind == Kind::text ? nearestName(value.text, choices) : std::string{};
    const std::string found = value.kind == Kind::text ? inQuotes(value.text) : describe(value);
    check.problems.add(value.at,
                       fmt::format("{} is {}, must be {}{}", nameOf(check.key), found, expectedText(check.key),
                                   nearest.empty() ? "" : fmt::format(", did you mean {}?", inQuotes(nearest))));
    return std::nullopt;
}

std::optional<Typed> textOf(const Check& check, const Value& value) {
    if (value.kind != Kind::text) {
        reportType(check, value);
        return std::nullopt;
    }
    Typed typed;
    typed.text = value.text;
    typed.canonical = inQuotes(value.text);
    return typed;
}

std::optional<Typed> textListOf(const Check& check, const Value& value) {
    if (value.kind != Kind::array) {
        reportType(check, value);
        return std::nullopt;
    }
    Typed typed;
    std::vector<std::string> quoted;
    for (std::size_t index = 0; index < value.items.size(); ++index) {
        const Value& item = value.items[index];
        if (item.kind != Kind::text)
            check.problems.add(item.at,
                               fmt::format("{}[{}] is {}, must be a string", nameOf(check.key), index, describe(item)));
        typed.texts.push_back(item.text);
        quoted.push_back(inQuotes(item.text));
        if (item.kind != Kind::text) return std::nullopt;
    }
    typed.canonical = fmt::format("[{}]", fmt::join(quoted, ", "));
    return typed;
}

std::optional<Typed> booleanOf(const Check& check, const Value& value) {
    if (value.kind != Kind::boolean) {
        reportType(check, value);
        return std::nullopt;
    }
    Typed typed;
    typed.flag = value.boolean;
    typed.canonical = value.boolean ? "true" : "false";
    return typed;
}

}  // namespace

std::optional<Typed> checkValue(const Key& key, const Value& value, ProblemList& problems) {
    const Check check{key, problems};
    if (value.kind == Kind::broken) {
        // Already reported, unless someone wrote the reader's own mark into a file.
        if (problems.empty()) reportType(check, value);
        return std::nullopt;
    }
    switch (key.type) {
        case Type::number:
        case Type::integer:
            return numberOf(check, value);
        case Type::numberList:
            return numberListOf(check, value);
        case Type::textList:
            return textListOf(check, value);
        case Type::boolean:
            return booleanOf(check, value);
        case Type::text:
            return textOf(check, value);
        case Type::choice:
            return choiceOf(check, value);
        case Type::vec3:
        case Type::counts:
        case Type::color:
            return singleVectorOf(check, value);
        case Type::vec3List:
        case Type::colorList:
            return vectorListOf(check, value);
        case Type::interval:
        case Type::size:
            return pairOf(check, value);
    }
    return std::nullopt;
}

}  // namespace scenes
