// Text in tables that other programs read.
#pragma once

#include <string>

namespace studies {

/// One field, in quotation marks where it needs them (RFC 4180).
std::string csvField(const std::string& text);

}  // namespace studies
