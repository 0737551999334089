// globular approve: makes actual pictures the goldens, and prints which.
#include <fmt/format.h>

#include <memory>

#include "tools/commands/commands.h"
#include "tools/compare/approve.h"

namespace tools {
namespace {

struct ApproveOptions {
    ApproveJob job;
    RunOptions run;  ///< --json and --quiet; the number of threads is not used
};

void approve(const ApproveOptions& options) {
    const std::vector<Approved> approved = approvePictures(options.job);
    for (const Approved& picture : approved)
        printResult(options.run, {{"event", "approved"}, {"name", picture.name}, {"new", picture.isNew}},
                    fmt::format("{} {}\n", picture.isNew ? "new golden:" : "approved:", picture.name));
    if (approved.empty() && options.run.verbosity() == Verbosity::normal)
        fmt::print("nothing to approve: the goldens are the same\n");
}

}  // namespace

void addApproveCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("approve", "actual pictures become goldens, each with where it comes from beside it");
    const auto options = std::make_shared<ApproveOptions>();
    command.add_option("ACTUAL", options->job.actual, "a PNG or a folder of PNGs")->required();
    command.add_option("EXPECTED", options->job.expected, "the golden one, or their folder")->required();
    command.add_option("NAME", options->job.names, "which, as compare prints them (default: all of ACTUAL)");
    command.add_flag("--force", options->job.force, "also where another renderer or OpenGL driver drew the golden");
    command.add_flag("--json", options->run.json, "one JSON object a line");
    command.add_flag("--quiet", options->run.quiet, "print nothing");
    command.footer("Example: globular approve out/liquid golden/liquid frame-00030.png");
    command.callback([options] { approve(*options); });
}

}  // namespace tools
