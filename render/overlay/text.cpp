// stb_truetype over the embedded font. The font is part of the build, so nothing here can fail on a file.
#include "render/overlay/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "render/overlay/font_data.h"

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

constexpr int kReplacement = 0xFFFD;

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo kFont = [] {
        stbtt_fontinfo info;
        if (stbtt_InitFont(&info, fontData(), 0) == 0) throw std::logic_error("render: the built-in font is no font");
        return info;
    }();
    return kFont;
}

/// How many bytes follow the first one of a character; -1 if it cannot be the first.
int tailLength(unsigned char first) {
    if (first < 0x80) return 0;
    if (first >= 0xC2 && first < 0xE0) return 1;
    if (first >= 0xE0 && first < 0xF0) return 2;
    return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

/// Takes the next character off the text.
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

/// Calls visit(glyph, its left end in pixels from the beginning) for each character. Returns the width of the line.
template <class Visit>
double layOut(std::string_view text, double em, const Visit& visit) {
    const double scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(em));
    double at = 0.0;
    int before = 0;
    while (!text.empty()) {
        const int glyph = stbtt_FindGlyphIndex(&font(), takeCharacter(text));
        if (before != 0) at += scale * stbtt_GetGlyphKernAdvance(&font(), before, glyph);
        visit(glyph, at);
        int advance = 0;
        int bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        at += scale * advance;
        before = glyph;
    }
    return at;
}

void coverGlyph(CoverageMask& mask, int glyph, const TextPlace& place) {
    const float scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(place.em));
    const int column = static_cast<int>(std::floor(place.left));
    const auto shift = static_cast<float>(place.left - column);
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(&font(), glyph, scale, scale, shift, 0.0F, &x0, &y0, &x1, &y1);
    const int width = x1 - x0;
    const int height = y1 - y0;
    if (width <= 0 || height <= 0) return;  // a space
    std::vector<std::uint8_t> bitmap(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    stbtt_MakeGlyphBitmapSubpixel(&font(), bitmap.data(), width, height, width, scale, scale, shift, 0.0F, glyph);
    for (int row = 0; row < height; ++row) {
        for (int k = 0; k < width; ++k) {
            const int x = column + x0 + k - mask.left;
            const int y = place.baseline + y0 + row - mask.top;
            if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) continue;
            std::uint8_t& at = mask.coverage[static_cast<std::size_t>(y * mask.width + x)];
            const int sum = at + bitmap[static_cast<std::size_t>(row * width + k)];
            at = static_cast<std::uint8_t>(std::min(sum, 255));
        }
    }
}

}  // namespace

double textWidth(std::string_view text, double em) {
    return layOut(text, em, [](int, double) {});
}

Box textBox(std::string_view text, const TextPlace& place) {
    // Room for accents, descenders and overhanging strokes of every Latin or Greek letter and every digit.
    return {place.left - 0.25 * place.em, place.baseline - 1.1 * place.em,
            place.left + textWidth(text, place.em) + 0.25 * place.em, place.baseline + 0.5 * place.em};
}

void coverText(CoverageMask& mask, std::string_view text, const TextPlace& place) {
    layOut(text, place.em, [&](int glyph, double at) {
        coverGlyph(mask, glyph, {place.left + at, place.baseline, place.em});
    });
}

}  // namespace render
