// The subcommands of the program. Each adds itself to the command line, with its flags, its help and what it does when
// it is called; failures come back to main as exceptions.
#pragma once

#include <CLI/CLI.hpp>

namespace tools {

void addRenderCommand(CLI::App& program);
void addStripCommand(CLI::App& program);
void addSimulateCommand(CLI::App& program);
void addFiguresCommand(CLI::App& program);
void addVideoCommand(CLI::App& program);
void addCompareCommand(CLI::App& program);
void addApproveCommand(CLI::App& program);
void addCheckCommand(CLI::App& program);
void addScenesCommand(CLI::App& program);
void addSchemaCommand(CLI::App& program);
void addStudyCommand(CLI::App& program);
void addBenchCommand(CLI::App& program);

/// Subcommands of `globular study`.
void addStudyAccuracy(CLI::App& study);
void addStudyPictures(CLI::App& study);
void addStudyScaling(CLI::App& study);
void addStudyStability(CLI::App& study);

}  // namespace tools
