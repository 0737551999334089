// Numbers that people write into flags and file names.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace tools {

/// The number that fills the text, whatever the locale; nothing where there is none, or more than one.
template <class Number = int>
std::optional<Number> parseNumber(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace tools
