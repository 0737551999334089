// Lines of text as coverage, in the one font that is built into the program (DejaVu Sans). Sizes are those of the
// font's em square, in pixels; a capital is about 0.73 of it high.
#pragma once

#include <string_view>

#include "render/overlay/coverage_mask.h"

namespace render {

/// Where a line of text stands.
struct TextPlace {
    double left = 0.0;  ///< where the first character begins
    int baseline = 0;   ///< the row that capitals stand on
    double em = 12.0;
};

/// How far the line reaches from its beginning, pixels. Text that is no UTF-8 shows the mark for it.
double textWidth(std::string_view text, double em);

/// A box that holds every pixel of the line; of scripts with taller marks than accents some may reach beyond it.
Box textBox(std::string_view text, const TextPlace& place);

/// Adds a line of text to what the mask covers; what does not fit on the mask is left out.
void coverText(CoverageMask& mask, std::string_view text, const TextPlace& place);

}  // namespace render
