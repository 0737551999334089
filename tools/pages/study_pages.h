// The pages of `globular study`: what was measured, in plots and tables, and the command that measures it again.
#pragma once

#include <string>
#include <vector>

#include "studies/accuracy/accuracy.h"
#include "studies/pictures/pictures.h"
#include "studies/scaling/scaling.h"
#include "studies/stability/stability.h"
#include "tools/system/text.h"

namespace tools {

/// The accuracy of one scene, with its two plots as SVG.
struct AccuracySection {
    studies::SceneAccuracy accuracy;
    std::string secondsPlot;      ///< error against seconds
    std::string evaluationsPlot;  ///< error against force evaluations
};

/// How the study of accuracy was run.
struct AccuracyRun {
    std::string command;
    int threads = 1;
    bool isTimedOnce = false;  ///< each run once, instead of in rounds
};

struct PictureResults {
    std::vector<studies::PictureRow> rows;
    std::vector<studies::FlickerRow> flicker;
    std::vector<studies::SmoothingRow> smoothing;
    std::string timesPlot;   ///< SVG
    std::string errorsPlot;  ///< SVG
};

struct ScalingResults {
    std::vector<studies::ScalingRow> rows;
    std::vector<studies::ScalingFit> fits;
    std::vector<studies::PeerRow> peers;  ///< empty if none was asked for
    std::string peerText;                 ///< how the peer was measured, or why it was not
    std::string plot;                     ///< SVG
};

std::string accuracyPage(const std::vector<AccuracySection>& sections, const AccuracyRun& run);
std::string picturesPage(const PictureResults& results, const std::string& command);
std::string scalingPage(const ScalingResults& results, const std::string& command);
/// The table of the cases, with a row for each.
Table stabilityTable(const std::vector<studies::CaseResult>& results);

std::string stabilityPage(const std::vector<studies::CaseResult>& results, const std::string& command);

}  // namespace tools
