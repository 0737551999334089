// What is written over a picture, as plain data: a time stamp, a scale bar and a color bar. Part of a View, filled in
// by scenes/build/build_picture.cpp; render/overlay/draw_overlay.h draws it over the finished picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// Shows a length at the distance of the camera's target, in the bottom left corner. It is left out of pictures that
/// are too narrow for it.
struct ScaleBar {
    float length = 1.0F;  ///< m
    std::string text;     ///< written above it
};

struct Tick {
    float position = 0.0F;  ///< 0 at the lower end of the bar, 1 at the upper end
    std::string text;
};

/// Shows which color stands for which number, in the bottom right corner.
struct ColorBar {
    std::vector<glm::vec3> colors;  ///< linear RGB, evenly spaced from the lower to the upper end; at least one
    std::string title;
    std::vector<Tick> ticks;
};

/// Texts are UTF-8, one line each.
struct Overlay {
    std::string stamp;  ///< in the top left corner; empty for none
    std::optional<ScaleBar> scaleBar;
    std::optional<ColorBar> colorBar;
    glm::vec3 ink{1.0F};  ///< of text and lines, linear RGB; their halo is black or white, whichever contrasts
    float size =
        1.0F;  ///< a factor on the text's em, which is 3 % of the picture's shorter side and at least 11 pixels
};

}  // namespace render
