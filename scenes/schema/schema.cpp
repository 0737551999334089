// Look-ups in the schema and the words that messages use for it.
#include "scenes/schema/schema.h"

#include <fmt/format.h>

#include <cmath>

#include "scenes/schema/schema_rows.h"
#include "scenes/text/located.h"

namespace scenes {

const std::vector<TableInfo>& tables() {
    static const std::vector<TableInfo> kTables = {
        {.name = "", .article = "a scene", .help = "keys above the first table"},
        {.name = "physics", .article = "[physics]", .help = "what acts on every particle, and how time advances"},
        {.name = "world", .article = "[world]", .help = "bounds beyond which a particle leaves the run, once a frame"},
        {.name = "material",
         .list = true,
         .article = "a material",
         .help = "what particles are made of; [[material]] for several"},
        {.name = "body",
         .single = false,
         .list = true,
         .discriminator = "shape",
         .article = "a body",
         .help = "particles that are there at the start"},
        {.name = "emitter",
         .single = false,
         .list = true,
         .discriminator = "shape",
         .article = "an emitter",
         .help = "where particles are born"},
        {.name = "obstacle",
         .single = false,
         .list = true,
         .discriminator = "shape",
         .article = "an obstacle",
         .help = "what particles bounce off"},
        {.name = "camera",
         .list = true,
         .inherits = true,
         .discriminator = "projection",
         .article = "a camera on a path",
         .help = "from where it is seen; [[camera]] for a path, each keeping what it leaves out from the one before"},
        {.name = "look", .discriminator = "color_by", .article = "[look]", .help = "how it is drawn"},
        {.name = "overlay", .article = "[overlay]", .help = "what is drawn over the finished picture, for figures"},
        {.name = "still", .article = "[still]", .help = "the single picture of the scene"},
        {.name = "study",
         .article = "[study]",
         .help = "a hard case of `globular study stability`: what is measured of it and how far that may go"},
    };
    return kTables;
}

const std::vector<Key>& schema() {
    static const std::vector<Key> kRows = [] {
        std::vector<Key> rows = worldRows();
        for (const std::vector<Key>& part : {contentRows(), pictureRows(), studyRows()})
            rows.insert(rows.end(), part.begin(), part.end());
        return rows;
    }();
    return kRows;
}

const TableInfo* findTable(std::string_view name) {
    for (const TableInfo& table : tables())
        if (table.name == name) return &table;
    return nullptr;
}

const Key* findKey(std::string_view table, std::string_view name) {
    for (const Key& key : schema())
        if (tableOf(key) == table && nameOf(key) == name) return &key;
    return nullptr;
}

std::string_view tableOf(const Key& key) {
    const std::size_t end = key.path.find_first_of("[.");
    return end == std::string_view::npos ? std::string_view{} : key.path.substr(0, end);
}

std::string_view nameOf(const Key& key) {
    const std::size_t dot = key.path.find('.');
    return dot == std::string_view::npos ? key.path : key.path.substr(dot + 1);
}

std::vector<const Key*> keysOf(std::string_view table) {
    std::vector<const Key*> keys;
    for (const Key& key : schema())
        if (tableOf(key) == table) keys.push_back(&key);
    return keys;
}

std::string rangeText(const Range& range) {
    const bool hasLow = std::isfinite(range.low);
    const bool hasHigh = std::isfinite(range.high);
    if (hasLow && hasHigh && !range.lowOpen && !range.highOpen)
        return fmt::format("{} to {}", numberText(range.low), numberText(range.high));
    std::string text;
    if (hasLow) text = fmt::format("{} {}", range.lowOpen ? ">" : ">=", numberText(range.low));
    if (hasHigh)
        text += fmt::format("{}{} {}", hasLow ? " and " : "", range.highOpen ? "<" : "<=", numberText(range.high));
    return text;
}

std::string expectedText(const Key& key) {
    switch (key.type) {
        case Type::number:
            return "a number";
        case Type::numberList:
            return "a list of numbers";
        case Type::integer:
            return "a whole number";
        case Type::boolean:
            return "true or false";
        case Type::text:
            return "a string";
        case Type::textList:
            return "a list of strings";
        case Type::vec3:
            return "three numbers [x, y, z]";
        case Type::vec3List:
            return "a list of [x, y, z]";
        case Type::color:
            return "\"#rrggbb\" or [r, g, b]";
        case Type::colorList:
            return "a list of colors \"#rrggbb\"";
        case Type::interval:
            return "two numbers [low, high], low below high";
        case Type::size:
            return "two whole numbers [width, height]";
        case Type::counts:
            return "three whole numbers [nx, ny, nz]";
        case Type::choice:
            break;
    }
    std::string text;
    for (std::size_t index = 0; index < key.choices.size(); ++index) {
        if (index > 0) text += index + 1 == key.choices.size() ? " or " : ", ";
        text += inQuotes(key.choices[index]);
    }
    return text;
}

std::string unitWords(std::string_view unit) {
    static const std::vector<std::pair<std::string_view, std::string_view>> kWords = {
        {"m", "meters"}, {"s", "seconds"}, {"kg", "kilograms"}, {"1/s", "per second"}, {"m/s", "meters per second"}};
    for (const auto& [symbol, words] : kWords)
        if (symbol == unit) return std::string(words);
    return std::string(unit);
}

}  // namespace scenes
