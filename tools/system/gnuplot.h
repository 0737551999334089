// Plots, drawn by the program gnuplot.
#pragma once

#include <string>

namespace tools {

/// The SVG that gnuplot writes to its standard output for a script.
/// Throws: render::SystemError when gnuplot is missing, naming the package, or fails, with its own words.
std::string drawPlot(const std::string& script);

}  // namespace tools
