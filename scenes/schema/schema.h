// The schema: every table and key that a scene file may contain, each described once. Parsing, validation, defaults,
// messages, `globular schema` and docs/scenes.md all follow from it. To add a key, add a row to one of the keys_*.cpp
// files, and read its value in scenes/build/.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scenes {

enum class Type {
    number,
    numberList,
    integer,
    frameRate,  ///< a whole number, or a fraction "30000/1001"
    boolean,
    string,
    stringList,
    choice,
    vec3,  ///< [x, y, z]
    vec3List,
    color,  ///< a color, "#rrggbb" in sRGB or [r, g, b] in linear light
    colorList,
    pairList,  ///< list of [a, b]
    interval,  ///< [low, high]
    size,      ///< [width, height], whole numbers of pixels
    counts     ///< [nx, ny, nz], whole numbers
};

/// Bounds of a number, or of each component of a vector.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool isLowExcluded = false;
    bool isHighExcluded = false;
};

/// A key of a table in a scene file. All texts are static. The member functions return a changed copy, so that a key is
/// written as `key("fps", Type::frameRate, "1/s", "frames per second").within({1, 240}).defaultsTo("30")`.
struct Key {
    std::string_view table{};  ///< name of the table; empty for keys above the first table
    std::string_view name{};
    Type type = Type::number;
    std::string_view unit{};  ///< symbol of the unit, e.g. "m/s"; empty for none
    std::string_view help{};  ///< one line
    Range range{};
    std::vector<std::string_view> choices{};
    std::string_view defaultValue{};    ///< constant default as TOML text; empty for none
    std::string_view derivedDefault{};  ///< a default that depends on other keys, in words; empty for none
    bool isRequired = false;            ///< the key must be given in every table that it applies to
    bool isSimulated = true;            ///< whether the states of the particles may depend on the key
    bool isInherited = true;            ///< whether a table may take the key from the one before in its list
    std::vector<std::string_view>
        appliesTo{};  ///< those values of the table's discriminator for which the key applies; empty: all

    Key within(const Range& allowed) && {
        range = allowed;
        return std::move(*this);
    }
    Key oneOf(std::vector<std::string_view> allowed) && {
        choices = std::move(allowed);
        return std::move(*this);
    }
    Key defaultsTo(std::string_view toml) && {
        defaultValue = toml;
        return std::move(*this);
    }
    Key derivedAs(std::string_view words) && {
        derivedDefault = words;
        return std::move(*this);
    }
    Key required() && {
        isRequired = true;
        return std::move(*this);
    }
    Key notSimulated() && {
        isSimulated = false;
        return std::move(*this);
    }
    Key notInherited() && {
        isInherited = false;
        return std::move(*this);
    }
    Key onlyFor(std::vector<std::string_view> variants) && {
        appliesTo = std::move(variants);
        return std::move(*this);
    }
};

/// A table of a scene file; the one without a name stands for the keys above the first table.
struct TableInfo {
    std::string_view name{};     ///< as in its header; "obstacle.key" is a list of tables within each [[obstacle]]
    std::string_view subject{};  ///< in messages: "a body"
    std::string_view help{};
    bool allowsSingle = true;          ///< the table may be written once, as [name]
    bool allowsList = false;           ///< the table may be written several times, as [[name]]
    bool inheritsPrevious = false;     ///< a table in a list takes what it leaves out from the one before
    std::string_view increasing{};     ///< a number that has to increase from each table of a list to the next
    bool isSimulated = true;           ///< whether the states of the particles may depend on any of its keys
    std::string_view discriminator{};  ///< the key that determines which others apply, e.g. "shape"; empty for none
};

const std::vector<TableInfo>& tables();

/// All keys of all tables, in the order of tables().
const std::vector<Key>& schema();

/// The table with the given name; nullptr if there is none.
const TableInfo* findTable(std::string_view name);

/// Whether [name] or [[name]] is a table of a scene file that is not within another table.
inline bool isTableName(std::string_view name) {
    return !name.empty() && name.find('.') == std::string_view::npos && findTable(name) != nullptr;
}

/// The name of the table that a table is within: "obstacle" for "obstacle.key"; empty if it is in none.
std::string_view parentOf(const TableInfo& table);

/// The name of a table within its parent: "key" for "obstacle.key".
std::string_view localNameOf(const TableInfo& table);

/// The tables within a table, in the order of the schema.
std::vector<const TableInfo*> tablesWithin(std::string_view table);

/// The key with the given name in a table; nullptr if there is none.
const Key* findKey(std::string_view table, std::string_view name);

/// The keys of a table, in the order of the schema.
std::vector<const Key*> keysOf(std::string_view table);

/// The name of a key with its table: "title", "physics.gravity", "body[].shape", "obstacle[].key[].time".
std::string pathOf(const Key& key);

/// A range as messages show it: "> 0", "1 to 240", ">= 0 and < 1"; empty for an unbounded one.
std::string rangeText(const Range& range);

/// What the value of a key must be, for messages: "a number", "true or false", `"all" or "random"`.
std::string expectedText(const Key& key);

/// The name of a type in lists of keys: "number", "list of [x, y, z]".
std::string typeText(Type type);

/// A unit as messages show it: spelled out if it is common ("meters" for "m"), otherwise its symbol.
std::string unitWords(std::string_view unit);

}  // namespace scenes
