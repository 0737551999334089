// Lookups in TOML values, and their text in messages.
#include "scenes/text/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

/// Messages show no more of a string in a scene file than this, bytes.
constexpr std::size_t kMaxQuotedLength = 40;

/// Cuts a long string off for a message, but never within the bytes of one UTF-8 character.
std::string shortened(const std::string& text) {
    if (text.size() <= kMaxQuotedLength) return text;
    std::size_t end = kMaxQuotedLength;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

}  // namespace

const Entry* findEntry(const Value& table, std::string_view key) {
    const auto found = std::ranges::find(table.entries, key, &Entry::key);
    return found == table.entries.end() ? nullptr : &*found;
}

std::string describe(const Value& value) {
    switch (value.kind) {
        case ValueKind::boolean:
            return value.boolean ? "true" : "false";
        case ValueKind::integer:
            return fmt::format("{}", value.integer);
        case ValueKind::floatingPoint:
            return formatNumber(value.number);
        case ValueKind::string:
            return tomlString(shortened(value.string)) + " (a string)";
        case ValueKind::dateTime:
            return "a date or time";
        case ValueKind::array:
            return fmt::format("a list of {}", value.items.size());
        case ValueKind::table:
            return "a table";
        case ValueKind::invalid:
            break;
    }
    return "unreadable";
}

std::string tomlString(std::string_view text) {
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

std::string formatNumber(double number) {
    if (std::isnan(number)) return "nan";
    return fmt::format("{}", number);
}

}  // namespace scenes
