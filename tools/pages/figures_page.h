// The page that shows the figures: one HTML file with everything in it, to be opened from disk or sent by mail.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tools {

/// What the page shows of one figure.
struct FigureEntry {
    int number = 0;
    std::string title;
    std::string description;
    std::string constants;                                        ///< of its law and step, in one line
    std::string stillPath;                                        ///< PNG
    std::string stripPath;                                        ///< PNG, several moments side by side
    std::string videoPath;                                        ///< MP4
    double stillTime = 0.0;                                       ///< s
    std::vector<double> stripTimes;                               ///< s
    std::vector<std::pair<std::string, std::string>> parameters;  ///< key and value as in the scene file
    std::string command;                                          ///< renders the scene again
    std::string stateHash;
};

/// The page as HTML, pictures and videos embedded. Reads the files; throws render::SystemError.
std::string figuresPage(const std::vector<FigureEntry>& figures);

}  // namespace tools
