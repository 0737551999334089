// The pages of `globular study`: what was measured, in plots and tables, and the command that measures it again.
#pragma once

#include <string>
#include <vector>

#include "studies/accuracy/accuracy.h"
#include "studies/accuracy/whole_scene.h"
#include "studies/meshes/meshes.h"
#include "studies/pictures/pictures.h"
#include "studies/scaling/scaling.h"
#include "studies/stability/stability.h"
#include "tools/system/text.h"

namespace tools {

/// The accuracy of one scene, with its two plots as SVG.
struct AccuracySection {
    studies::SceneAccuracy accuracy;
    std::string secondsPlot;      ///< SVG of error against seconds
    std::string evaluationsPlot;  ///< SVG of error against force evaluations
};

/// How the study of accuracy was run.
struct AccuracyRun {
    std::string command;
    int threads = 1;
    bool isTimedOnce = false;  ///< each run was timed once, instead of in rounds
};

struct PictureResults {
    std::vector<studies::PictureRow> rows;
    std::vector<studies::LookRow> looks;
    std::vector<studies::FlickerRow> flicker;
    std::vector<studies::SmoothingRow> smoothing;
    std::string openGl;      ///< which OpenGL was measured, or why none was
    std::string timesPlot;   ///< SVG of milliseconds a frame against particles
    std::string errorsPlot;  ///< SVG of error against milliseconds a frame
};

struct ScalingResults {
    std::vector<studies::ScalingRow> rows;
    std::vector<studies::ScalingFit> fits;
    std::vector<studies::PeerRow> peers;  ///< times of another program; empty if none was asked for
    std::string peerText;                 ///< how the other program was measured, or why it was not
    std::string plot;                     ///< SVG of milliseconds a step against particles
};

std::string accuracyPage(const std::vector<AccuracySection>& sections, const AccuracyRun& run);
/// The page of `globular study accuracy --whole`.
std::string wholePage(const std::vector<studies::WholeScene>& scenes, const AccuracyRun& run);
/// @param particles  number of particles in the dam break that was meshed
std::string meshesPage(const std::vector<studies::MeshRow>& rows, std::size_t particles, const std::string& command);
std::string picturesPage(const PictureResults& results, const std::string& command);
std::string scalingPage(const ScalingResults& results, const std::string& command);
/// The results of the stability study as a table, with a row for each hard case.
Table stabilityTable(const std::vector<studies::CaseResult>& results);

std::string stabilityPage(const std::vector<studies::CaseResult>& results, const std::string& command);

}  // namespace tools
