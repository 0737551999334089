// Lines of text as coverage masks, in the font that is built into the program (DejaVu Sans). Sizes are those of the
// font's em square, in pixels; a capital letter is about 0.73 em high. Called by draw_overlay.cpp and panel_strip.cpp.
#pragma once

#include <string>
#include <string_view>

#include "render/overlay/coverage_mask.h"

namespace render {

/// Position and size of a line of text, in pixels of the picture.
struct TextPosition {
    double left = 0.0;  ///< x of the left end of the first character
    int baseline = 0;   ///< y of the lower end of capitals
    double em = 12.0;
};

/// Width of a line of UTF-8 text, pixels. Bytes that are not UTF-8 count as replacement characters (U+FFFD).
double textWidth(std::string_view text, double em);

/// A box that contains every pixel of a line of text. In scripts other than Latin and Greek, tall marks may reach
/// beyond the box.
Box textBox(std::string_view text, const TextPosition& position);

/// The characters of a text (UTF-8) that the font does not have and that are drawn as boxes.
std::string charactersWithoutGlyph(std::string_view text);

/// Whether a text (UTF-8) has letters of a script that is written from right to left. They are drawn from left to
/// right, and those of Arabic without their joins.
bool hasRightToLeftLetters(std::string_view text);

/// Covers a line of text in the mask. Parts of the text outside of the mask are left out.
void coverText(CoverageMask& mask, std::string_view text, const TextPosition& position);

}  // namespace render
