// The overlay of a picture as plain data: time stamp, scale bar and color bar. A View has one.
// scenes/build/build_picture.cpp fills it in, and render/overlay/draw_overlay.h draws it over the finished picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// A bar in the bottom left corner that shows how long a length is at the distance of the camera's target. It is left
/// out of pictures that are too narrow.
struct ScaleBar {
    float length = 1.0F;  ///< m
    std::string text;     ///< the text above the bar
};

struct Tick {
    float position = 0.0F;  ///< 0 at the lower end of the color bar, 1 at the upper end
    std::string text;
};

/// A bar in the bottom right corner that shows which color stands for which number.
struct ColorBar {
    std::vector<glm::vec3> colors;  ///< linear RGB at even distances from the lower to the upper end; at least one
    std::string title;
    std::vector<Tick> ticks;
};

/// The overlay of a picture. All texts are UTF-8, one line each.
struct Overlay {
    std::string stamp;  ///< time stamp in the top left corner; empty for none
    std::optional<ScaleBar> scaleBar;
    std::optional<ColorBar> colorBar;
    glm::vec3 ink{1.0F};  ///< color of text and lines, linear RGB; their halo is black or white, for contrast
    float size = 1.0F;    ///< factor on the text's em: 3 % of the picture's shorter side, at least 11 pixels
};

}  // namespace render
