// globular generate: writes the man page or the bash completion. The build runs it; it is hidden from users.
#include <memory>

#include "tools/commands/commands.h"
#include "tools/system/output_file.h"

namespace tools {

void addGenerateCommand(CLI::App& program, const std::string& version) {
    struct Options {
        std::string kind;
        std::string output;
    };
    CLI::App& command = *program.add_subcommand("generate", "write the man page or the bash completion");
    command.group("");
    const auto options = std::make_shared<Options>();
    command.add_option("KIND", options->kind, "man or completion")
        ->required()
        ->check(CLI::IsMember({"man", "completion"}));
    command.add_option("FILE", options->output, "the file to write")->required();
    command.callback([options, version, &program] {
        writeFile(options->output, options->kind == "man" ? manPage(program, version) : bashCompletion(program));
    });
}

}  // namespace tools
