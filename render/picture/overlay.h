// What a figure carries besides its picture, as plain data: a time stamp, a scale bar, a color bar. Part of a view;
// draw_overlay.h draws it over the finished picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// A length as it looks at the distance of the camera's target, in the lower left corner. Left out of pictures that it
/// does not fit into.
struct ScaleBar {
    float length = 1.0F;  ///< m
    std::string text;     ///< what it says
};

struct Tick {
    float place = 0.0F;  ///< 0 at the lower end of the bar, 1 at the upper
    std::string text;
};

/// Which color stands for which number, in the lower right corner.
struct ColorBar {
    std::vector<glm::vec3> colors;  ///< linear RGB, evenly spaced from the lower end to the upper; at least one
    std::string title;
    std::vector<Tick> ticks;
};

/// Texts are UTF-8, one line each.
struct Overlay {
    std::string stamp;  ///< in the upper left corner; empty: none
    std::optional<ScaleBar> scaleBar;
    std::optional<ColorBar> colorBar;
    glm::vec3 ink{1.0F};  ///< of text and lines, linear RGB; they have a halo of black or white, whichever contrasts
    float size = 1.0F;    ///< of the text, in its usual height: 3 % of the picture's shorter side, at least 11 pixels
};

}  // namespace render
