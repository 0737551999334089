// Curves of a gnuplot script. What the plots of `study scaling` and `study pictures` share.
#pragma once

#include <string>
#include <vector>

namespace studies {

/// One line of a plot.
struct Curve {
    std::string title;
    std::string look;    ///< gnuplot's words for it
    std::string points;  ///< x and y, a line each; an empty line ends a line of points
};

/// The beginning of every script: an SVG with logarithmic axes, a grid and a border.
extern const char* const kPlotFrame;

/// The end of a script: all curves that have points, with these inline.
std::string plotOf(const std::vector<Curve>& curves);

}  // namespace studies
