// JSON as the program reads and writes it, with the members in the order in which they were added.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tools {

using Json = nlohmann::ordered_json;

/// JSON on one line. Bytes that are not valid UTF-8, which the names of files may contain, become U+FFFD.
std::string compactText(const Json& json);

/// JSON for people: each level is indented by two spaces, and a line end follows. Bytes that are not valid UTF-8 become
/// U+FFFD.
std::string indentedText(const Json& json);

}  // namespace tools
