// Plots of the studies, drawn by the program gnuplot.
#pragma once

#include <string>

namespace tools {

/// The SVG that gnuplot writes to its standard output for a script.
/// @throws render::SystemError naming the package if gnuplot is missing, or with gnuplot's own message if it fails
std::string drawPlot(const std::string& script);

}  // namespace tools
