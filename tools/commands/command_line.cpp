// The flags that several commands share, checks of flags, and the messages for command lines that CLI11 rejects.
#include "tools/commands/commands.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "scenes/text/edit_distance.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// A check that accepts the finite numbers for which a condition holds.
/// @param words  completes the message "must be a number ..."
CLI::Validator numberThat(const std::function<bool(double)>& holds, const std::string& words) {
    return CLI::Validator(
        [=](const std::string& text) {
            const auto value = parseNumber<double>(text);
            return value && std::isfinite(*value) && holds(*value) ? "" : text + " must be a number " + words;
        },
        "");
}

/// The innermost subcommand that was called, such as accuracy in "globular study accuracy".
const CLI::App& calledCommand(const CLI::App& app) {
    const auto called = app.get_subcommands();
    return called.empty() ? app : calledCommand(*called.back());
}

/// The words that call a command, such as "globular study accuracy".
std::string callOf(const CLI::App& app) {
    return app.get_parent() == nullptr ? app.get_name() : callOf(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> commandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
        names.push_back(command->get_name());
    return names;
}

std::vector<std::string> flagNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    return names;
}

/// The error message for a word that is no flag, argument or subcommand, with the nearest known name.
std::string unknownWordMessage(const CLI::App& command, const std::string& word) {
    const bool isFlag = word.starts_with("-");
    const std::vector<std::string> known = isFlag ? flagNames(command) : commandNames(command);
    const std::string nearest = scenes::nearestName(word, known);
    const char* kind = isFlag ? "flag" : known.empty() ? "argument" : "command";
    if (!nearest.empty()) return fmt::format("unknown {} \"{}\", did you mean \"{}\"?", kind, word, nearest);
    return fmt::format("unknown {} \"{}\"; see {} --help", kind, word, callOf(command));
}

[[noreturn]] void failWithoutCommand(const CLI::App& app) {
    throw ExitStatus(kInputErrorCode, fmt::format("missing command; see {} --help", callOf(app)));
}

}  // namespace

void addTo(CLI::App& command, RunOptions& options) {
    command.add_flag("--quiet", options.quiet, "no progress and no summary");
    command.add_flag("--json", options.json, "progress and result as JSON, one object a line, on stdout");
    command
        .add_option("--threads", options.threads,
                    "how many threads to use (default: one for each processor that it may use)")
        ->check(CLI::Range(1, 1024));
}

void addTo(CLI::App& command, SceneOptions& options) {
    command
        .add_option("SCENE", options.scene,
                    "a scene file, - for standard input, or the name of a built-in scene (see globular scenes)")
        ->required();
    command.add_option("--set", options.changes, "change a key of the scene, e.g. --set physics.step=0.005")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--limit", options.limits, "allow a larger scene: particles=N, frames=N or pixels=N (of a picture)")
        ->type_name("NAME=N")
        ->allow_extra_args(false);
}

void addTo(CLI::App& command, DrawOptions& options) {
    command.add_option("--size", options.size, "picture size in pixels (default: the scene's)")->type_name("WxH");
    command.add_option("--style", options.style, "spheres or metaballs (default: the scene's)")
        ->check(CLI::IsMember({"spheres", "metaballs"}));
    command.add_option("--quality", options.quality, "draft, normal or final (default: normal)")
        ->check(CLI::IsMember({"draft", "normal", "final"}));
    addRendererFlags(command, options);
}

void addRendererFlags(CLI::App& command, DrawOptions& options) {
    command
        .add_option("--renderer", options.renderer,
                    fmt::format("cpu or opengl: what draws (default: {})", options.renderer))
        ->check(CLI::IsMember(kRendererNames));
    addDeviceFlag(command, options);
}

void addDeviceFlag(CLI::App& command, DrawOptions& options) {
    command
        .add_option("--gl", options.device,
                    "where OpenGL draws: osmesa, egl or egl:N, see globular devices (default: osmesa)")
        ->type_name("DEVICE");
}

void addTo(CLI::App& command, FolderOptions& options, const std::string& help) {
    command.add_option("-o,--output", options.path, help)->type_name("DIR");
    CLI::Option* resume =
        command.add_flag("--resume", options.resume, "go on with a run that ended early: what is whole stays");
    command.add_flag("--overwrite", options.overwrite, "remove the frames of another run from the folder first")
        ->excludes(resume);
    command.add_option("--checkpoint", options.checkpointSeconds, "seconds between two checkpoints (default: 5)")
        ->type_name("SECONDS")
        ->check(numberAtLeastZero());
}

void addStrictFlag(CLI::App& command, SceneOptions& options) {
    command.add_flag("--strict", options.isStrict, "treat warnings about the scene as errors, before anything is run");
}

void addErrorFlag(CLI::App& command, bool& estimatesErrors) {
    command.add_flag_callback(
        "--no-error-estimate", [&estimatesErrors] { estimatesErrors = false; },
        "with a fixed step, do not spend time on estimating its error");
}

CLI::Validator numberFrom(double least, double most) {
    return numberThat([=](double value) { return value >= least && value <= most; },
                      fmt::format("from {:g} to {:g}", least, most));
}

CLI::Validator numberAtLeastZero() {
    return numberThat([](double value) { return value >= 0.0; }, ">= 0");
}

CLI::Validator numberAboveZero() {
    return numberThat([](double value) { return value > 0.0; }, "> 0");
}

void runCommandLine(CLI::App& program, int argc, char** argv) {
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            program.exit(error);  // prints what --help, --version or --licenses asks for
            return;
        }
        const CLI::App& command = calledCommand(program);
        const std::vector<std::string> unknown = command.remaining();
        const bool isIncomplete = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
        const bool hasExtras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        if ((isIncomplete || hasExtras) && !unknown.empty())
            throw ExitStatus(kInputErrorCode, unknownWordMessage(command, unknown.front()));
        if (isIncomplete && !commandNames(command).empty()) failWithoutCommand(command);
        throw ExitStatus(kInputErrorCode, error.what());
    }
    if (program.get_subcommands().empty()) failWithoutCommand(program);
}

}  // namespace tools
