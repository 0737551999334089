// A figure of the loads of obstacles over time, from the loads.csv of a run. Used by `globular plot`.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tools/system/gnuplot.h"

namespace tools {

/// The load of an obstacle in an interval, or at its end; LoadTable says more.
struct LoadPoint {
    double time = 0.0;                ///< end of the interval, s
    std::array<double, 3> force{};    ///< mean over the interval, N
    std::array<double, 3> torque{};   ///< mean over the interval, N m
    std::array<double, 3> impulse{};  ///< since the start, N s
    double work = 0.0;                ///< since the start, J
};

/// The loads of a run, in order of time, by the numbers of the obstacles, which count from 1.
using LoadsOverTime = std::map<int, std::vector<LoadPoint>>;

/// Reads a loads.csv.
/// @throws scenes::InputError with the line if the file is none, cannot be read or has no rows
LoadsOverTime readLoads(const std::filesystem::path& file);

/// What a figure of loads is of.
struct LoadFigure {
    std::string title;                 ///< of the scene; may be empty
    std::map<int, std::string> names;  ///< of the obstacles to draw, by their numbers
    PlotFormat format = PlotFormat::svg;
};

/// The gnuplot script of a figure: a column for each obstacle, with its force, its torque and its work over time.
/// @pre all obstacles of the figure are among the loads
std::string loadPlotScript(const LoadsOverTime& loads, const LoadFigure& figure);

}  // namespace tools
