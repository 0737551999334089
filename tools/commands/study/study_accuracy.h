// What the two parts of `globular study accuracy` have in common: windows of scenes, and whole scenes.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "studies/accuracy/reference.h"
#include "tools/commands/study/study_command.h"

namespace tools {

struct AccuracyOptions : StudyOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> overrides;
    bool whole = false;   ///< whole scenes instead of windows
    double from = -1.0;   ///< simulated time of the start, s; negative: a share of the still's time
    double window = 0.0;  ///< simulated length of the runs, s; 0: the default
};

/// The name of a scene in tables and of files.
/// @param scene  name or path
std::string subjectName(const std::string& scene);

/// Returns a function that reports each run when it is done.
studies::RunListener runReporter(const AccuracyOptions& options, const std::string& scene);

/// The command line that repeats the study.
std::string commandOf(const AccuracyOptions& options);

/// Measures whole scenes; writes tables and a page.
void studyWhole(const AccuracyOptions& options);

}  // namespace tools
