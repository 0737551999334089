// Draws plots with gnuplot, which reads the script from a pipe. The plot is taken from its output.
#pragma once

#include <string>

namespace tools {

/// The file formats of plots. The script has to set a terminal of the same format.
enum class PlotFormat { svg, png };

/// Draws a plot with gnuplot and returns the bytes of its file.
/// @throws render::SystemError naming the package if gnuplot is missing, or with gnuplot's own message if it fails
std::string drawWithGnuplot(const std::string& script, PlotFormat format = PlotFormat::svg);

}  // namespace tools
