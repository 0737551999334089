// The page of the accuracy study: plots, tables, and how to have them again, in one HTML file.
#pragma once

#include <string>
#include <vector>

#include "studies/accuracy/accuracy.h"

namespace tools {

/// A scene's results and its two plots as SVG.
struct AccuracySection {
    studies::SceneAccuracy accuracy;
    std::string secondsPlot;
    std::string evaluationsPlot;
};

/// How the study was run.
struct StudyRun {
    std::string command;
    int threads = 1;
    bool isTimedOnce = false;  ///< each run, instead of in rounds
};

/// The page as HTML, plots embedded.
std::string accuracyPage(const std::vector<AccuracySection>& sections, const StudyRun& facts);

}  // namespace tools
