// Checks of flags, and the messages for command lines that CLI11 rejects.
#include "tools/commands/command_line.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "scenes/text/edit_distance.h"
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
    throw UsageError(fmt::format("missing command; see {} --help", callOf(app)));
}

}  // namespace

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
            throw UsageError(unknownWordMessage(command, unknown.front()));
        if (isIncomplete && !commandNames(command).empty()) failWithoutCommand(command);
        throw UsageError(error.what());
    }
    if (program.get_subcommands().empty()) failWithoutCommand(program);
}

}  // namespace tools
