// Commands and flags, implemented with CLI11.
#include "tools/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <optional>

#include "scenes/text/edit_distance.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// Accepts finite numbers with a property. CLI11's own checks accept NaN and infinity, and their messages name the
/// largest double as the upper bound.
/// @param words  completes "must be a number ..."
CLI::Validator numberThat(const std::function<bool(double)>& holds, const std::string& words) {
    return CLI::Validator(
        [=](const std::string& text) {
            const auto value = parseNumber<double>(text);
            return value && std::isfinite(*value) && holds(*value) ? "" : text + " must be a number " + words;
        },
        "");
}

/// The innermost command that was called.
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

/// Describes the first word of the command line that nothing accepts, with the nearest known name.
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

Flag& Flag::required() {
    option_->required();
    return *this;
}

Flag& Flag::of(const std::string& placeholder) {
    option_->type_name(placeholder);
    return *this;
}

Flag& Flag::within(int least, int most) {
    option_->check(CLI::Range(least, most));
    return *this;
}

Flag& Flag::within(double least, double most) {
    option_->check(numberThat([=](double value) { return value >= least && value <= most; },
                              fmt::format("from {:g} to {:g}", least, most)));
    return *this;
}

Flag& Flag::atLeastZero() {
    option_->check(numberThat([](double value) { return value >= 0.0; }, ">= 0"));
    return *this;
}

Flag& Flag::aboveZero() {
    option_->check(numberThat([](double value) { return value > 0.0; }, "> 0"));
    return *this;
}

Flag& Flag::oneOf(const std::vector<std::string>& names) {
    option_->check(CLI::IsMember(names));
    return *this;
}

Flag& Flag::oneAtATime() {
    option_->allow_extra_args(false);
    return *this;
}

Flag& Flag::showDefault() {
    option_->capture_default_str();
    return *this;
}

Flag& Flag::notWith(const Flag& other) {
    option_->excludes(other.option_);
    return *this;
}

Command Command::command(const std::string& name, const std::string& help) const {
    return Command(*app_->add_subcommand(name, help));
}

template <class Value>
Flag Command::option(const std::string& names, Value& value, const std::string& help) const {
    return Flag(*app_->add_option(names, value, help));
}

template Flag Command::option(const std::string&, std::string&, const std::string&) const;
template Flag Command::option(const std::string&, std::filesystem::path&, const std::string&) const;
template Flag Command::option(const std::string&, int&, const std::string&) const;
template Flag Command::option(const std::string&, double&, const std::string&) const;
template Flag Command::option(const std::string&, std::optional<int>&, const std::string&) const;
template Flag Command::option(const std::string&, std::optional<double>&, const std::string&) const;
template Flag Command::option(const std::string&, std::vector<std::string>&, const std::string&) const;
template Flag Command::option(const std::string&, std::vector<int>&, const std::string&) const;
template Flag Command::option(const std::string&, std::vector<std::size_t>&, const std::string&) const;

Flag Command::flag(const std::string& names, bool& value, const std::string& help) const {
    return Flag(*app_->add_flag(names, value, help));
}

void Command::example(const std::string& text, const std::string& notes) const {
    app_->footer((notes.empty() ? "" : notes + "\n") + "Example: " + text);
}

void Command::run(std::function<void()> action) const {
    app_->callback(std::move(action));
}

void Command::needsCommand() const {
    app_->require_subcommand(1);
}

void Command::hide() const {
    app_->group("");
}

void Command::printingFlag(const std::string& name, const std::string& help, std::function<std::string()> text) const {
    // CLI11 prints the text of this exception and nothing else.
    app_->add_flag_callback(
        name, [text] { throw CLI::CallForVersion(text(), CLI::ExitCodes::Success); }, help);
}

CommandLine::CommandLine(const std::string& name, const std::string& help)
    : app_(std::make_unique<CLI::App>(help, name)) {
    app_->require_subcommand(0, 1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::program() const {
    return Command(*app_);
}

void CommandLine::run(int argc, char** argv) const {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app_->exit(error);  // prints the help or the text of a printing flag
            return;
        }
        const CLI::App& command = calledCommand(*app_);
        const std::vector<std::string> unknown = command.remaining();
        const bool isIncomplete = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
        const bool hasExtras = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        if ((isIncomplete || hasExtras) && !unknown.empty())
            throw UsageError(unknownWordMessage(command, unknown.front()));
        if (isIncomplete && !commandNames(command).empty()) failWithoutCommand(command);
        throw UsageError(error.what());
    }
    if (app_->get_subcommands().empty()) failWithoutCommand(*app_);
}

}  // namespace tools
