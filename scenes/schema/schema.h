// The table of every key that a scene file may hold, each once. Parsing, range checks, defaults, messages and
// `globular schema` are all driven by it; a new key starts with a row here and is then read by the builder of its
// table.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

enum class Type {
    number,
    numberList,
    integer,
    boolean,
    text,
    textList,
    choice,
    vec3,  ///< [x, y, z]
    vec3List,
    color,  ///< "#rrggbb" in sRGB, or [r, g, b] in linear light
    colorList,
    interval,  ///< [low, high]
    size,      ///< [width, height] in whole pixels
    counts     ///< [nx, ny, nz], whole numbers
};

/// Bounds of a number, or of each component of a vector.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool lowOpen = false;  ///< low itself is not allowed
    bool highOpen = false;
};

/// One row. Texts are static.
struct Key {
    std::string_view path{};  ///< "title", "physics.gravity", "body[].shape"
    Type type = Type::number;
    std::string_view unit{};      ///< symbol, e.g. "m/s"; empty for none
    std::string_view fallback{};  ///< default, in TOML; empty for none
    std::string_view derived{};   ///< default in words, where it depends on other keys
    bool required = false;        ///< in every table it applies to
    Range range{};
    std::vector<std::string_view> choices{};
    std::vector<std::string_view> appliesTo{};  ///< values of the table's discriminator; empty: all
    std::string_view help{};                    ///< one line
};

/// The tables of a scene file; the one without a name holds the keys at the top.
struct TableInfo {
    std::string_view name{};
    bool single = true;                ///< may be written [name]
    bool list = false;                 ///< may be written [[name]]
    bool inherits = false;             ///< an item takes what it leaves out from the one before, not from the defaults
    std::string_view discriminator{};  ///< the key that decides which others apply
    std::string_view article{};        ///< "a body", for messages
    std::string_view help{};
};

const std::vector<TableInfo>& tables();

/// All keys in the order of tables().
const std::vector<Key>& schema();

/// nullptr if there is no such table.
const TableInfo* findTable(std::string_view name);

/// Whether a table of a scene has this name; the one at the top has none.
inline bool isSection(std::string_view name) {
    return !name.empty() && findTable(name) != nullptr;
}

/// nullptr if the table has no such key.
const Key* findKey(std::string_view table, std::string_view name);

/// The parts of a path: "body" and "shape" of "body[].shape".
std::string_view tableOf(const Key& key);
std::string_view nameOf(const Key& key);

/// The keys of a table, in order.
std::vector<const Key*> keysOf(std::string_view table);

/// "> 0", "1 to 240", ">= 0 and < 1"; empty without bounds.
std::string rangeText(const Range& range);

/// "a number", "true or false", `"all" or "random"`.
std::string expectedText(const Key& key);

/// "meters" of "m"; the symbol itself where it has no such word.
std::string unitWords(std::string_view unit);

/// One key as columns of text, for tables and JSON.
struct SchemaRow {
    std::string key;
    std::string type;
    std::string unit;
    std::string fallback;   ///< in TOML, or in words in parentheses; "required" or "none" otherwise
    std::string range;      ///< bounds or choices
    std::string appliesTo;  ///< e.g. "shape ball, grid"; empty: always
    std::string help;
};

std::vector<SchemaRow> schemaRows();

/// The whole table as text for a terminal.
std::string schemaText();

}  // namespace scenes
