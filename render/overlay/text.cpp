// Draws text with stb_truetype, in the font that is built into the program.
#include "render/overlay/text.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "render/overlay/built_in_font.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wextra"
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb_truetype.h>
#pragma GCC diagnostic pop

namespace render {

namespace {

constexpr int kReplacement = 0xFFFD;  // replacement character U+FFFD, drawn for bytes that are not UTF-8

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo kFont = [] {
        stbtt_fontinfo info;
        if (stbtt_InitFont(&info, builtInFont(), 0) == 0)
            throw std::logic_error("render: the built-in font is not a TrueType font");
        return info;
    }();
    return kFont;
}

/// The number of bytes that follow the first byte of a character in UTF-8; -1 if the byte cannot be the first of a
/// character.
int tailLength(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xC2 && first < 0xE0) return 1;
    if (first >= 0xE0 && first < 0xF0) return 2;
    return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

/// Removes the first character from the text and returns its code point.
int takeCharacter(std::string_view& text) {
    const auto first = static_cast<unsigned char>(text.front());
    const int tail = tailLength(first);
    text.remove_prefix(1);
    if (tail == 0) return first;
    if (tail < 0) return kReplacement;
    int character = first & (0x3F >> tail);
    for (int k = 0; k < tail; ++k) {
        if (text.empty() || (static_cast<unsigned char>(text.front()) & 0xC0) != 0x80) return kReplacement;
        character = (character << 6) | (static_cast<unsigned char>(text.front()) & 0x3F);
        text.remove_prefix(1);
    }
    return character;
}

/// Calls visit(glyph, x) for each character of a line of text, where x is the left end of the character in pixels from
/// the beginning of the line. Returns the width of the line.
template <class Visit>
double layOut(std::string_view text, double em, const Visit& visit) {
    const double scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(em));
    double x = 0.0;
    int previous = 0;
    while (!text.empty()) {
        const int glyph = stbtt_FindGlyphIndex(&font(), takeCharacter(text));
        if (previous != 0) x += scale * stbtt_GetGlyphKernAdvance(&font(), previous, glyph);
        visit(glyph, x);
        int advance = 0;
        int bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        x += scale * advance;
        previous = glyph;
    }
    return x;
}

void coverGlyph(CoverageMask& mask, int glyph, const TextPosition& position) {
    const float scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(position.em));
    const int column = static_cast<int>(std::floor(position.left));
    const auto shift = static_cast<float>(position.left - column);
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shift, 0.0F, &x0, &y0, &x1, &y1);
    const int width = x1 - x0;
    const int height = y1 - y0;
    if (width <= 0 || height <= 0) return;  // the glyph has no pixels: a space, for example
    std::vector<std::uint8_t> bitmap(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    stbtt_MakeGlyphBitmapSubpixel(&font(), bitmap.data(), width, height, width, scale, scale, shift, 0.0F, glyph);
    for (int row = 0; row < height; ++row)
        for (int k = 0; k < width; ++k)
            addCoverage(mask, column + x0 + k, position.baseline + y0 + row,
                        bitmap[static_cast<std::size_t>(row * width + k)]);
}

}  // namespace

double textWidth(std::string_view text, double em) {
    return layOut(text, em, [](int, double) {});
}

std::string charactersWithoutGlyph(std::string_view text) {
    std::string missing;
    while (!text.empty()) {
        const std::string_view before = text;
        if (stbtt_FindGlyphIndex(&font(), takeCharacter(text)) != 0) continue;
        const std::string_view character = before.substr(0, before.size() - text.size());
        if (missing.find(character) == std::string::npos) missing += character;
    }
    return missing;
}

bool hasRightToLeftLetters(std::string_view text) {
    while (!text.empty()) {
        const int character = takeCharacter(text);
        // Unicode's blocks from Hebrew to Arabic Extended-A, and the presentation forms of Hebrew and Arabic.
        if ((character >= 0x0590 && character < 0x0900) || (character >= 0xFB1D && character < 0xFE00) ||
            (character >= 0xFE70 && character < 0xFEFF))
            return true;
    }
    return false;
}

Box textBox(std::string_view text, const TextPosition& position) {
    // The box has room for accents, descenders and overhanging strokes of every Latin or Greek letter and digit in
    // DejaVu Sans.
    return {position.left - 0.25 * position.em, position.baseline - 1.1 * position.em,
            position.left + textWidth(text, position.em) + 0.25 * position.em, position.baseline + 0.5 * position.em};
}

void coverText(CoverageMask& mask, std::string_view text, const TextPosition& position) {
    layOut(text, position.em, [&](int glyph, double x) {
        coverGlyph(mask, glyph, {position.left + x, position.baseline, position.em});
    });
}

}  // namespace render
