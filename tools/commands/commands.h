// The subcommands of the program. Each adds itself to the command line, with its flags, its help and what it does when
// it is called; failures come back to main as exceptions.
#pragma once

#include "tools/run/command_line.h"

namespace tools {

void addRenderCommand(const Command& program);
void addStripCommand(const Command& program);
void addSimulateCommand(const Command& program);
void addFiguresCommand(const Command& program);
void addVideoCommand(const Command& program);
void addCompareCommand(const Command& program);
void addApproveCommand(const Command& program);
void addCheckCommand(const Command& program);
void addScenesCommand(const Command& program);
void addSchemaCommand(const Command& program);
void addStudyCommand(const Command& program);
void addBenchCommand(const Command& program);

/// Subcommands of `globular study`.
void addStudyAccuracy(const Command& study);
void addStudyPictures(const Command& study);
void addStudyScaling(const Command& study);
void addStudyStability(const Command& study);

}  // namespace tools
