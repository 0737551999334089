// Parts of the HTML pages that the program writes. Every page is one file with all pictures in it, to be opened from
// disk or sent by mail.
#pragma once

#include <string>
#include <vector>

#include "tools/system/text.h"

namespace tools {

/// The text with the characters that have a meaning in HTML replaced.
std::string escaped(const std::string& text);

/// Standard base64 (RFC 4648) with padding.
std::string base64(const std::vector<unsigned char>& bytes);

/// The bytes of a file as a URI that a page can use as a source.
/// @param type  the media type, such as "image/png"
std::string dataUri(const std::string& type, const std::vector<unsigned char>& bytes);

/// A table of unescaped texts.
/// @param isBad  which rows are highlighted; empty: none
std::string htmlTable(const Table& table, const std::vector<bool>& isBad = {});

/// An SVG as an image.
/// @param alt  needs no escaping
std::string svgImage(const std::string& alt, const std::string& svg);

/// A whole page with the program's style.
/// @param title  also its heading; needs no escaping
/// @param body  HTML
std::string htmlPage(const std::string& title, const std::string& body);

}  // namespace tools
