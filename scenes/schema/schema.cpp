// The tables of a scene file, look-ups of tables and keys, and the words that messages use for types and units.
#include "scenes/schema/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/schema/keys.h"
#include "scenes/text/value.h"

namespace scenes {
namespace {

struct TypeWords {
    Type type = Type::number;
    std::string_view name;
    std::string_view
        expected;  ///< what a value must be, for messages; empty for a choice, whose values depend on the key
};

const TypeWords& wordsOf(Type type) {
    static const std::vector<TypeWords> kWords = {
        {Type::number, "number", "a number"},
        {Type::numberList, "list of numbers", "a list of numbers"},
        {Type::integer, "integer", "a whole number"},
        {Type::frameRate, "integer or fraction", "a whole number or a fraction such as \"30000/1001\""},
        {Type::boolean, "boolean", "true or false"},
        {Type::string, "string", "a string"},
        {Type::stringList, "list of strings", "a list of strings"},
        {Type::choice, "choice", ""},
        {Type::vec3, "[x, y, z]", "three numbers [x, y, z]"},
        {Type::vec3List, "list of [x, y, z]", "a list of [x, y, z]"},
        {Type::color, "color", "\"#rrggbb\" or [r, g, b]"},
        {Type::colorList, "list of colors", "a list of colors \"#rrggbb\""},
        {Type::pairList, "list of [r, y]", "a list of [radius, height]"},
        {Type::interval, "[low, high]", "two numbers [low, high], low below high"},
        {Type::size, "[width, height]", "two whole numbers [width, height]"},
        {Type::counts, "[nx, ny, nz]", "three whole numbers [nx, ny, nz]"},
    };
    return *std::find_if(kWords.begin(), kWords.end(), [&](const TypeWords& words) { return words.type == type; });
}

}  // namespace

const std::vector<TableInfo>& tables() {
    static const std::vector<TableInfo> kTables = {
        {.name = "", .subject = "a scene", .help = "keys above the first table"},
        {.name = "physics", .subject = "[physics]", .help = "what acts on every particle, and how time is integrated"},
        {.name = "world", .subject = "[world]", .help = "bounds beyond which particles are removed, once per frame"},
        {.name = "air", .subject = "[air]", .help = "the air around the particles, in scenes that have heat"},
        {.name = "material",
         .subject = "a material",
         .help = "what particles are made of; [[material]] for several",
         .allowsList = true},
        {.name = "body",
         .subject = "a body",
         .help = "particles that exist from the start",
         .allowsSingle = false,
         .allowsList = true,
         .discriminator = "shape"},
        {.name = "emitter",
         .subject = "an emitter",
         .help = "a source of particles",
         .allowsSingle = false,
         .allowsList = true,
         .discriminator = "shape"},
        {.name = "emitter.key",
         .subject = "a key of an emitter",
         .help = "a moment on the path of the emitter above, which glides from key to key; each inherits from the one "
                 "before what it leaves out",
         .allowsSingle = false,
         .allowsList = true,
         .inheritsPrevious = true,
         .increasing = "time"},
        {.name = "obstacle",
         .subject = "an obstacle",
         .help = "what particles bounce off",
         .allowsSingle = false,
         .allowsList = true,
         .discriminator = "shape"},
        {.name = "obstacle.key",
         .subject = "a key of an obstacle",
         .help = "a moment on the path of the obstacle above, which glides from key to key; each inherits from the one "
                 "before what it leaves out",
         .allowsSingle = false,
         .allowsList = true,
         .inheritsPrevious = true,
         .increasing = "time"},
        {.name = "field",
         .subject = "a field",
         .help = "what acts on particles at a distance: a push, an attraction, a wind",
         .allowsSingle = false,
         .allowsList = true,
         .discriminator = "kind"},
        {.name = "camera",
         .subject = "a camera on a path",
         .help = "the point of view; [[camera]] for a path, where each inherits from the one before what it leaves out",
         .allowsList = true,
         .inheritsPrevious = true,
         .increasing = "time",
         .isSimulated = false,
         .discriminator = "projection"},
        {.name = "look",
         .subject = "[look]",
         .help = "how the scene is drawn",
         .isSimulated = false,
         .discriminator = "color_by"},
        {.name = "overlay",
         .subject = "[overlay]",
         .help = "text and scales drawn over the picture, for figures",
         .isSimulated = false},
        {.name = "still",
         .subject = "[still]",
         .help = "the picture, or strip of pictures, that represents the scene",
         .isSimulated = false},
        {.name = "study",
         .subject = "[study]",
         .help = "a case of `globular study stability`: what is measured, and the limits that it has to stay within",
         .isSimulated = false},
    };
    return kTables;
}

const std::vector<Key>& schema() {
    static const std::vector<Key> kKeys = [] {
        std::vector<Key> all;
        const auto add = [&](std::string_view table, std::vector<Key> keys) {
            for (Key& row : keys) {
                row.table = table;
                row.isSimulated = row.isSimulated && findTable(table)->isSimulated;
                all.push_back(std::move(row));
            }
        };
        add("", topKeys());
        add("physics", physicsKeys());
        add("world", worldKeys());
        add("air", airKeys());
        add("material", materialKeys());
        add("body", bodyKeys());
        add("emitter", emitterKeys());
        add("emitter.key", emitterPathKeys());
        add("obstacle", obstacleKeys());
        add("obstacle.key", obstaclePathKeys());
        add("field", fieldKeys());
        add("camera", cameraKeys());
        add("look", lookKeys());
        add("overlay", overlayKeys());
        add("still", stillKeys());
        add("study", studyKeys());
        return all;
    }();
    return kKeys;
}

const TableInfo* findTable(std::string_view name) {
    for (const TableInfo& table : tables())
        if (table.name == name) return &table;
    return nullptr;
}

std::string_view parentOf(const TableInfo& table) {
    const std::size_t dot = table.name.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : table.name.substr(0, dot);
}

std::string_view localNameOf(const TableInfo& table) {
    const std::string_view parent = parentOf(table);
    return parent.empty() ? table.name : table.name.substr(parent.size() + 1);
}

std::vector<const TableInfo*> tablesWithin(std::string_view table) {
    std::vector<const TableInfo*> within;
    for (const TableInfo& candidate : tables())
        if (!table.empty() && parentOf(candidate) == table) within.push_back(&candidate);
    return within;
}

const Key* findKey(std::string_view table, std::string_view name) {
    for (const Key& key : schema())
        if (key.table == table && key.name == name) return &key;
    return nullptr;
}

std::vector<const Key*> keysOf(std::string_view table) {
    std::vector<const Key*> keys;
    for (const Key& key : schema())
        if (key.table == table) keys.push_back(&key);
    return keys;
}

std::string pathOf(const Key& key) {
    std::string path(key.name);
    const TableInfo* table = findTable(key.table);
    while (table != nullptr && !table->name.empty()) {
        path = fmt::format("{}{}.{}", localNameOf(*table), table->allowsList ? "[]" : "", path);
        table = findTable(parentOf(*table));
    }
    return path;
}

std::string rangeText(const Range& range) {
    const bool hasLow = std::isfinite(range.low);
    const bool hasHigh = std::isfinite(range.high);
    if (hasLow && hasHigh && !range.isLowExcluded && !range.isHighExcluded)
        return fmt::format("{} to {}", formatNumber(range.low), formatNumber(range.high));
    std::string text;
    if (hasLow) text = fmt::format("{} {}", range.isLowExcluded ? ">" : ">=", formatNumber(range.low));
    if (hasHigh)
        text +=
            fmt::format("{}{} {}", hasLow ? " and " : "", range.isHighExcluded ? "<" : "<=", formatNumber(range.high));
    return text;
}

std::string expectedText(const Key& key) {
    if (key.type != Type::choice) return std::string(wordsOf(key.type).expected);
    std::string text;
    for (std::size_t index = 0; index < key.choices.size(); ++index) {
        if (index > 0) text += index + 1 == key.choices.size() ? " or " : ", ";
        text += tomlString(key.choices[index]);
    }
    return text;
}

std::string typeText(Type type) {
    return std::string(wordsOf(type).name);
}

std::string unitWords(std::string_view unit) {
    static const std::vector<std::pair<std::string_view, std::string_view>> kWords = {
        {"m", "meters"}, {"s", "seconds"}, {"kg", "kilograms"}, {"1/s", "per second"}, {"m/s", "meters per second"}};
    for (const auto& [symbol, words] : kWords)
        if (symbol == unit) return std::string(words);
    return std::string(unit);
}

}  // namespace scenes
