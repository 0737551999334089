// What the pages of the program share: escaped text, files inlined.
#pragma once

#include <string>
#include <vector>

namespace tools {

/// The text with the characters that HTML gives a meaning to replaced.
std::string escaped(const std::string& text);

/// Standard base64 (RFC 4648) with padding.
std::string base64(const std::vector<unsigned char>& bytes);

/// A file within the page. Shape: type as in "image/png".
std::string dataUri(const std::string& type, const std::vector<unsigned char>& bytes);

/// The texts of one row of a table.
using Cells = std::vector<std::string>;

/// A table of escaped texts.
std::string table(const Cells& head, const std::vector<Cells>& rows);

/// The beginning of a study's page: title, style and heading. Shape: neither text needs escaping.
std::string studyHead(const std::string& title, const std::string& style);

/// An SVG as an image within the page. Shape: alt needs no escaping.
std::string picture(const std::string& alt, const std::string& svg);

}  // namespace tools
