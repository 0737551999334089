// Makes text of JSON with nlohmann::json. Bytes that are not UTF-8 are replaced instead of throwing.
#include "tools/system/json.h"

namespace tools {

std::string compactText(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string indentedText(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tools
