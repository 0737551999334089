// Building blocks of what the studies write: fields of CSV tables and gnuplot scripts of log-log plots.
#pragma once

#include <string>
#include <vector>

namespace studies {

/// A field of a CSV line, in quotation marks if it needs them (RFC 4180).
std::string csvField(const std::string& text);

/// One curve of a plot.
struct Curve {
    std::string title;
    std::string style;       ///< gnuplot's "with ..." clause, without "with"
    std::string points;      ///< a line "x y" or "x y label" for each point; an empty line interrupts the curve
    std::string labelStyle;  ///< gnuplot's options for the labels; empty if the points have none
};

/// The beginning of every script: SVG output, logarithmic axes, a grid, a border.
extern const char* const kPlotHeader;

/// A gnuplot plot command with the points as inline data. Curves without points are left out.
std::string plotCommand(const std::vector<Curve>& curves);

}  // namespace studies
