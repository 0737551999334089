// The values of a TOML file, each with the position where it is written, and their text in messages. The reader of
// scenes works with these types; only schema/document.cpp knows the TOML library that parses the file.
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// Where something was written: in the scene file, or in one of the overrides. Positions are ordered: those in the file
/// come before those in the overrides.
struct SourcePosition {
    int overrideIndex = -1;  ///< index of the override that contains the value; -1: the file does
    int line = 0;            ///< line number from 1; 0 stands for the file as a whole
    int column = 0;

    auto operator<=>(const SourcePosition&) const = default;
};

enum class ValueKind {
    boolean,
    integer,
    floatingPoint,
    string,
    dateTime,
    array,
    table,
    invalid  ///< a syntax error that has already been reported
};

/// Where the value of a key in a built scene comes from.
enum class ValueOrigin {
    given,          ///< the file or an override
    schemaDefault,  ///< the constant default of the schema
    derived         ///< a default computed from other keys
};

struct Entry;

struct Value {
    ValueKind kind = ValueKind::table;
    SourcePosition position;
    bool boolean = false;
    std::int64_t integer = 0;
    double number = 0.0;  ///< value of a floating-point number or of an integer
    std::string string;
    std::vector<Value> items;    ///< elements of an array
    std::vector<Entry> entries;  ///< entries of a table, in the order written
};

struct Entry {
    std::string key;
    SourcePosition position;  ///< position of the key
    Value value;
};

/// The entry of a table that has the given key; nullptr if there is none.
const Entry* findEntry(const Value& table, std::string_view key);

/// A value as messages show it: `"big" (a string)`, `3`, `a list of 2`.
std::string describe(const Value& value);

/// A string as TOML text in quotes, with special characters escaped.
std::string tomlString(std::string_view text);

/// The shortest TOML text that reads back as the same number.
std::string formatNumber(double number);

}  // namespace scenes
