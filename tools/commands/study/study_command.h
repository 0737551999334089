// What the subcommands of `globular study` have in common: flags, the command line that repeats a study, and how a
// study reports its progress and its results.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/commands/commands.h"
#include "tools/system/json.h"

namespace tools {

void addStudyAccuracy(CLI::App& study);
void addStudyMeshes(CLI::App& study);
void addStudyPictures(CLI::App& study);
void addStudyScaling(CLI::App& study);
void addStudyStability(CLI::App& study);

/// The options that every study has.
struct StudyOptions {
    RunOptions run;
    std::string name;    ///< name of the subcommand, such as "accuracy"
    std::string folder;  ///< folder of the tables, the plots and the page
    bool quick = false;
};

/// Adds the flags of every study, and sets the study's name and its folder, by default out/study-NAME.
/// @param quickHelp  what --quick leaves out
void addStudyFlags(CLI::App& command, StudyOptions& options, const std::string& quickHelp);

/// Creates the folder of the study, after making sure that no table, plot or page replaces a file that the study reads.
/// @throws scenes::InputError
void prepareFolder(const StudyOptions& options, const std::vector<std::filesystem::path>& inputs);

/// The name of a scene as a word of a command line that is not taken for a flag.
std::string operandOf(const std::string& scene);

/// The command line that repeats a study.
/// @param words  the arguments and flags that only this study has
std::string commandLineOf(const StudyOptions& options, const std::vector<std::string>& words);

/// Reports one finished part of a study: a JSON object with --json, else a line on standard error unless --quiet.
void reportProgress(const StudyOptions& options, const Json& json, const std::string& line);

/// Draws a plot with gnuplot, writes it into the study's folder, and returns it as SVG.
/// @throws as drawWithGnuplot() does
std::string writePlot(const StudyOptions& options, const std::string& fileName, const std::string& script);

/// Writes index.html into the study's folder and reports that the study is done.
/// @param summary  tables for the terminal; printed unless --quiet or --json
void finishStudy(const StudyOptions& options, const std::string& page, const std::string& summary);

}  // namespace tools
