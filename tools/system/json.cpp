// Prints JSON with nlohmann::json. Bytes that are not UTF-8 are replaced instead of throwing.
#include "tools/system/json.h"

#include <fmt/format.h>

#include <cstdio>

#include "tools/system/text.h"

namespace tools {

std::string compactText(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string indentedText(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void printJson(const Json& json) {
    fmt::print("{}\n", printable(compactText(json)));
    std::fflush(stdout);  // so that a program that reads along gets each line at once
}

}  // namespace tools
