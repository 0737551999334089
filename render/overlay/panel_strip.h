// Joins several pictures side by side, each with a line of text below, as a figure in a paper shows a motion. Called by
// tools/run/stills.cpp.
#pragma once

#include <string>
#include <vector>

#include "render/picture/image.h"

namespace render {

struct Panel {
    Image image;
    std::string text;  ///< text centered below the image, one line of UTF-8
};

/// The panels from left to right on white, with thin gaps between them. Their pixels are copied unchanged.
/// @param panels  at least one, all of the same size
Image joinPanels(const std::vector<Panel>& panels);

}  // namespace render
