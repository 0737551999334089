#include "scenes/shapes/text_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "render/overlay/built_in_font.h"
#include "scenes/text/input_error.h"

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

namespace scenes {
namespace {

/// Chords of each curve of a letter. Chosen: a round letter has eight curves, of which a chord is off by 1e-3.
constexpr int kChords = 8;

/// Removes the first character from a valid UTF-8 text and returns its code point.
int takeCharacter(std::string_view& text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    int character = length == 1 ? first : first & (0xFF >> (length + 1));
    for (std::size_t k = 1; k < std::min(length, text.size()); ++k)
        character = (character << 6) | (static_cast<unsigned char>(text[k]) & 0x3F);
    text.remove_prefix(std::min(length, text.size()));
    return character;
}

/// Lines of letters in units of the font.
class Letters {
 public:
    Letters(const stbtt_fontinfo& font, const std::string& source) : font_(font), source_(source) {
        outline_.isByWinding = true;
    }

    void addLine(std::string_view line, double baseline) {
        const std::size_t first = outline_.edges.size();
        double x = 0.0;
        int previous = 0;
        while (!line.empty()) {
            const std::string_view before = line;
            const int glyph = stbtt_FindGlyphIndex(&font_, takeCharacter(line));
            if (glyph == 0)
                throw InputError(source_, fmt::format("the font has no \"{}\"; give another font",
                                                      before.substr(0, before.size() - line.size())));
            if (previous != 0) x += stbtt_GetGlyphKernAdvance(&font_, previous, glyph);
            addGlyph(glyph, x, baseline);
            int advance = 0;
            int bearing = 0;
            stbtt_GetGlyphHMetrics(&font_, glyph, &advance, &bearing);
            x += advance;
            previous = glyph;
        }
        for (std::size_t k = first; k < outline_.edges.size(); ++k)
            for (OutlinePoint& point : outline_.edges[k]) point[0] -= 0.5 * x;
    }

    Outline outline() && { return std::move(outline_); }

 private:
    void addGlyph(int glyph, double x, double y) {
        stbtt_vertex* vertices = nullptr;
        const int count = stbtt_GetGlyphShape(&font_, glyph, &vertices);
        const std::unique_ptr<stbtt_vertex, decltype(&std::free)> owner(vertices, &std::free);
        for (int k = 0; k < count; ++k) {
            const stbtt_vertex& v = vertices[k];
            const OutlinePoint to{x + v.x, y + v.y};
            if (v.type == STBTT_vmove) {
                close();
                start_ = to;
            } else if (v.type == STBTT_vline) {
                outline_.edges.push_back({at_, to});
            } else {
                const OutlinePoint control{x + v.cx, y + v.cy};
                addCurve(control, v.type == STBTT_vcubic ? OutlinePoint{x + v.cx1, y + v.cy1} : control, to,
                         v.type == STBTT_vcubic);
            }
            at_ = to;
        }
        close();
        start_ = at_ = {};
    }

    void close() {
        if (at_ != start_) outline_.edges.push_back({at_, start_});
    }

    void addCurve(const OutlinePoint& one, const OutlinePoint& other, const OutlinePoint& to, bool isCubic) {
        OutlinePoint last = at_;
        for (int k = 1; k <= kChords; ++k) {
            const double t = static_cast<double>(k) / kChords;
            const double s = 1.0 - t;
            OutlinePoint point = to;
            for (std::size_t axis = 0; axis < 2 && k < kChords; ++axis)
                point[axis] = isCubic ? s * s * s * at_[axis] + 3.0 * s * s * t * one[axis] +
                                            3.0 * s * t * t * other[axis] + t * t * t * to[axis]
                                      : s * s * at_[axis] + 2.0 * s * t * one[axis] + t * t * to[axis];
            outline_.edges.push_back({last, point});
            last = point;
        }
    }

    const stbtt_fontinfo& font_;
    const std::string& source_;
    Outline outline_;
    OutlinePoint start_{}, at_{};
};

double capitalHeight(const stbtt_fontinfo& font) {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;
    const int glyph = stbtt_FindGlyphIndex(&font, 'H');
    if (glyph != 0 && stbtt_GetGlyphBox(&font, glyph, &x0, &y0, &x1, &y1) != 0 && y1 > 0) return y1;
    stbtt_GetFontVMetrics(&font, &y1, &y0, &x1);
    return y1;
}

void scaleAroundMiddle(Outline& outline, double factor) {
    const engine::BoundingBox box = Extrusion(outline, 0.0).bounds();
    const engine::Vec3 middle = box.middle();
    for (auto& edge : outline.edges)
        for (OutlinePoint& point : edge) point = {factor * (point[0] - middle.x()), factor * (point[1] - middle.y())};
}

}  // namespace

Outline textOutline(std::string_view text, double height, const std::vector<std::uint8_t>& font,
                    const std::string& source) {
    stbtt_fontinfo info;
    const unsigned char* const bytes = font.empty() ? render::builtInFont() : font.data();
    const int offset = stbtt_GetFontOffsetForIndex(bytes, 0);
    if (offset < 0 || stbtt_InitFont(&info, bytes, offset) == 0)
        throw InputError(source, "not a TrueType or OpenType font");
    int ascent = 0;
    int descent = 0;
    int gap = 0;
    stbtt_GetFontVMetrics(&info, &ascent, &descent, &gap);
    Letters letters(info, source);
    double baseline = 0.0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        letters.addLine(text.substr(0, end), baseline);
        baseline -= ascent - descent + gap;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    Outline outline = std::move(letters).outline();
    if (!outline.edges.empty()) scaleAroundMiddle(outline, height / capitalHeight(info));
    return outline;
}

}  // namespace scenes
