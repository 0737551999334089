// globular study: measurements of the program itself, one subcommand for each question.
#include "tools/commands/commands.h"

namespace tools {

void addStudyCommand(const Command& program) {
    const Command study = program.command("study", "measurements: tables, plots, one page");
    study.needsCommand();
    study.example("globular study accuracy liquid -o out/accuracy");
    addStudyAccuracy(study);
    addStudyPictures(study);
    addStudyScaling(study);
    addStudyStability(study);
}

}  // namespace tools
