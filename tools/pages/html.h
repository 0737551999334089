// Parts of the HTML pages that the program writes. Every page but the report of `compare` is one file with all pictures
// in it, to be opened from disk or sent by mail.
#pragma once

#include <string>
#include <vector>

#include "tools/system/text.h"

namespace tools {

/// The text with every character that HTML would interpret replaced by an entity.
std::string escaped(const std::string& text);

/// Standard base64 (RFC 4648) with padding.
std::string base64(const std::vector<unsigned char>& bytes);

/// The bytes of a file as a URI that a page can use as a source.
/// @param type  the media type, such as "image/png"
std::string dataUri(const std::string& type, const std::vector<unsigned char>& bytes);

/// A table as HTML. Its texts are escaped here.
/// @param isBad  which rows are highlighted; empty: none
std::string htmlTable(const Table& table, const std::vector<bool>& isBad = {});

/// An SVG as an HTML image.
/// @param alt  alternative text, without characters that HTML would interpret
std::string svgImage(const std::string& alt, const std::string& svg);

/// A whole page with the program's style.
/// @param title  title and heading, without characters that HTML would interpret; begins with the program's name, by
/// which isOwnPage() knows the page
/// @param body  HTML
std::string htmlPage(const std::string& title, const std::string& body);

}  // namespace tools
