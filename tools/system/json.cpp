// Calls of nlohmann::json, with one policy for bytes that are not UTF-8: they are replaced.
#include "tools/system/json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace tools {

std::string utf8(const std::string& bytes) {
    return Json::parse(compactText(bytes)).get<std::string>();
}

std::string compactText(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string indentedText(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

void printJson(const Json& json) {
    fmt::print("{}\n", compactText(json));
}

Json parsedJson(std::span<const std::uint8_t> text) {
    return Json::parse(text.begin(), text.end());
}

nlohmann::json sortedJsonOrNull(std::span<const std::uint8_t> text) {
    const nlohmann::json json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    return json.is_discarded() ? nlohmann::json(nullptr) : json;
}

}  // namespace tools
