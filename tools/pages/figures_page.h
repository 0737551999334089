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
    std::string constants;                                        ///< the force law and the step, in one line
    std::string stillPath;                                        ///< PNG
    std::string stripPath;                                        ///< PNG, several times side by side
    std::string videoPath;                                        ///< MP4
    double stillTime = 0.0;                                       ///< seconds
    std::vector<double> stripTimes;                               ///< seconds
    std::vector<std::pair<std::string, std::string>> parameters;  ///< key and value as in the scene file
    std::string command;                                          ///< renders the scene again
    std::string stateHash;
};

/// Reads the pictures and videos and embeds them in the page.
/// @throws render::SystemError if one cannot be read
std::string figuresPage(const std::vector<FigureEntry>& figures);

}  // namespace tools
