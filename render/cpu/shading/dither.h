// The ordered dither of section 5 of shading_model.h, with which colors are rounded to 8 bits. Used by shade.cpp alone.
#pragma once

namespace render {

/// Side of the pattern of thresholds, which repeats over the picture, pixels.
inline constexpr int kDitherSide = 8;

/// What is added to the color of a pixel before it is rounded down, in steps of 1/255: (m + 1/2)/64 of shading_model.h.
/// @param x, y  column and row of the pixel; of no more than their last three bits does it depend
constexpr float ditherThreshold(unsigned x, unsigned y) {
    unsigned index = 0;
    for (unsigned bit = 0; bit < 3; ++bit) {
        const unsigned ofX = x >> bit & 1U;
        const unsigned ofY = y >> bit & 1U;
        index = 4 * index + 2 * (ofX ^ ofY) + ofY;
    }
    return (static_cast<float>(index) + 0.5F) / 64.0F;
}

}  // namespace render
