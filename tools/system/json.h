// JSON as the program reads and writes it, with the members in the order in which they were added. nlohmann's printer
// and parser are large templates, so they are instantiated here once and nowhere else.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace tools {

using Json = nlohmann::ordered_json;

/// The text with U+FFFD in place of bytes that are not valid UTF-8. File names may contain such bytes.
std::string utf8(const std::string& bytes);

/// JSON on one line. Its strings are made valid as by utf8().
std::string compactText(const Json& json);

/// JSON for people: each level is indented by the given number of spaces, and a line end follows.
std::string indentedText(const Json& json, int indent = 2);

/// Prints JSON on a line of its own to standard output, as --json promises.
void printJson(const Json& json);

/// Parses a text.
/// @throws nlohmann::json::parse_error
Json parsedJson(std::span<const std::uint8_t> text);

/// Parses a text that may be anything, and returns null if it is not JSON. Members are sorted, so that looking up one
/// of the thousands of frames of a manifest is fast.
nlohmann::json sortedJsonOrNull(std::span<const std::uint8_t> text);

}  // namespace tools
