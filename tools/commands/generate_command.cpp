// globular generate: writes the man page or the bash completion. The build runs it; it is hidden from users.
#include <memory>

#include "tools/commands/commands.h"
#include "tools/system/output_file.h"

namespace tools {

void addGenerateCommand(const Command& program, const std::string& version) {
    struct Options {
        std::string kind;
        std::string output;
    };
    const Command command = program.command("generate", "write the man page or the bash completion");
    command.hide();
    const auto options = std::make_shared<Options>();
    command.option("KIND", options->kind, "man or completion").required().oneOf({"man", "completion"});
    command.option("FILE", options->output, "the file to write").required();
    command.run([=] {
        writeFile(options->output, options->kind == "man" ? program.manPage(version) : program.bashCompletion());
    });
}

}  // namespace tools
