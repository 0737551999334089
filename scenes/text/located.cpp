// Lookups in located values and their text.
#include "scenes/text/located.h"

#include <fmt/format.h>

#include <cmath>

namespace scenes {
namespace {

/// Longer strings are cut in messages.
constexpr std::size_t kLongestQuote = 40;

template <class Table>
auto* findIn(Table& table, std::string_view key) {
    for (auto& entry : table.entries)
        if (entry.key == key) return &entry;
    return static_cast<decltype(table.entries.data())>(nullptr);
}

/// Cuts before a character, never within the bytes of one.
std::string shortened(const std::string& text) {
    if (text.size() <= kLongestQuote) return text;
    std::size_t end = kLongestQuote;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

}  // namespace

const Entry* findEntry(const Value& table, std::string_view key) {
    return findIn(table, key);
}
Entry* findEntry(Value& table, std::string_view key) {
    return findIn(table, key);
}

std::string describe(const Value& value) {
    switch (value.kind) {
        case Kind::boolean:
            return value.boolean ? "true" : "false";
        case Kind::integer:
            return fmt::format("{}", value.integer);
        case Kind::real:
            return numberText(value.real);
        case Kind::text:
            return inQuotes(shortened(value.text)) + " (a string)";
        case Kind::date:
            return "a date or time";
        case Kind::array:
            return fmt::format("a list of {}", value.items.size());
        case Kind::table:
            return "a table";
        case Kind::broken:
            break;
    }
    return "unreadable";
}

std::string inQuotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '\n')
            result += "\\n";
        else if (c == '\t')
            result += "\\t";
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            result += c;
    }
    return result + '"';
}

std::string numberText(double number) {
    if (std::isnan(number)) return "nan";
    return fmt::format("{}", number);
}

}  // namespace scenes
