// globular study: measurements of the program itself, one subcommand for each question.
#include "tools/commands.h"

namespace tools {

void addStudyCommand(CLI::App& program) {
    CLI::App* study = program.add_subcommand("study", "measurements: tables, plots, one page");
    study->require_subcommand(1);
    study->footer("Example: globular study accuracy liquid -o out/accuracy");
    addStudyAccuracy(*study);
    addStudyPictures(*study);
    addStudyScaling(*study);
    addStudyStability(*study);
}

}  // namespace tools
