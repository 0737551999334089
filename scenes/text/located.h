// Values of a scene file that remember where they were written. The whole reader works on these; only document.cpp
// knows the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// A place in the scene file, or the index of the override that gave the value.
struct Position {
    int line = 0;  ///< from 1; 0: the file as a whole
    int column = 0;
    int overrideIndex = -1;  ///< of the override that wrote it; -1: the file
};

enum class Kind {
    boolean,
    integer,
    real,
    text,
    date,
    array,
    table,
    broken  ///< a syntax error stood here and has been reported
};

struct Entry;

struct Value {
    Kind kind = Kind::table;
    Position at;
    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0.0;  ///< of an integer, too
    std::string text;
    std::vector<Value> items;    ///< of an array
    std::vector<Entry> entries;  ///< of a table, in the order written
};

struct Entry {
    std::string key;
    Position at;  ///< of the key
    Value value;
};

/// The entry of a table with the given key; nullptr if there is none.
const Entry* findEntry(const Value& table, std::string_view key);
Entry* findEntry(Value& table, std::string_view key);

/// What stands there, for messages: `"big" (a string)`, `3`, `a list of 2`.
std::string describe(const Value& value);

/// TOML text of a value that reads back as the same value.
std::string inQuotes(std::string_view text);
std::string numberText(double number);

}  // namespace scenes
