// JSON as the program writes and reads it, members in the order they were given. Its printer and its parser are large
// templates; they are compiled here, once.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace tools {

using Json = nlohmann::ordered_json;

/// A text with U+FFFD in the place of bytes that are no UTF-8, as the name of a file may have.
std::string utf8(const std::string& bytes);

/// JSON on one line, its texts as utf8() has them.
std::string compactText(const Json& json);

/// JSON for people, each level indented by so many spaces, with a line end.
std::string indentedText(const Json& json, int indent = 2);

/// A line of what `--json` promises.
void printJson(const Json& json);

/// What a text says.
/// Throws: nlohmann::json::parse_error.
Json parsedJson(std::span<const std::uint8_t> text);

/// What a text of others says, its members sorted, since a manifest may have thousands; null where it is no JSON.
nlohmann::json sortedJsonOrNull(std::span<const std::uint8_t> text);

}  // namespace tools
