// The page of `globular figures`: one HTML file that shows the paper's figures as drawn by this program.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tools {

/// One figure on the page.
struct FigureEntry {
    int number = 0;
    std::string title;
    std::string description;
    std::string constants;           ///< constants of the force law and the step, in one line
    std::string stillPath;           ///< path of the still picture, PNG
    std::string stripPath;           ///< path of the strip, PNG: several times side by side
    std::string videoPath;           ///< path of the video, MP4
    double stillTime = 0.0;          ///< simulated time of the still, s
    std::vector<double> stripTimes;  ///< simulated times of the pictures in the strip, s
    std::vector<std::pair<std::string, std::string>> parameters;  ///< keys and values as in the scene file
    std::string command;                                          ///< command line that renders the scene again
    std::string stateHash;
};

/// Reads the pictures and videos and embeds them in the page.
/// @throws render::SystemError if one cannot be read
std::string figuresPage(const std::vector<FigureEntry>& figures);

}  // namespace tools
