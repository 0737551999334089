// What the pages of the program share: escaped text, files inlined.
#pragma once

#include <string>
#include <vector>

namespace tools {

/// The text with the characters that HTML gives a meaning to replaced.
std::string escaped(const std::string& text);

/// Standard base64 (RFC 4648) with padding.
std::string base64(const std::vector<unsigned char>& bytes);

}  // namespace tools
