// Several pictures side by side with a line of text below each, as papers print a motion.
#pragma once

#include <string>
#include <vector>

#include "render/picture/image.h"

namespace render {

struct Panel {
    Image image;
    std::string text;  ///< UTF-8, centered below
};

/// The panels from left to right on white, with thin separators. Shape: at least one panel, all of one size.
/// Holds:  the pixels of a panel are those of its image.
Image joinPanels(const std::vector<Panel>& panels);

}  // namespace render
