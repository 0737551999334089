// The command line: commands with their flags, their help, and what they do. The rest of the program sees CLI11 through
// these classes alone, because its headers take longer to compile than a whole subcommand.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tools {

/// One flag or argument of a command. All members return the flag itself.
class Flag {
 public:
    explicit Flag(CLI::Option& option) : option_(&option) {}

    Flag& required();
    /// Sets what stands for the value in the help, such as "DIR".
    Flag& of(const std::string& placeholder);
    /// Requires a number from least to most, both included.
    Flag& within(int least, int most);
    Flag& within(double least, double most);
    Flag& atLeastZero();
    Flag& aboveZero();
    Flag& oneOf(const std::vector<std::string>& names);
    /// Each further value needs the flag again: --set A --set B.
    Flag& oneAtATime();
    Flag& showDefault();
    Flag& notWith(const Flag& other);

 private:
    CLI::Option* option_;
};

/// A command or subcommand. The variables that its flags are read into must live until it has run.
class Command {
 public:
    explicit Command(CLI::App& app) : app_(&app) {}

    Command command(const std::string& name, const std::string& help) const;

    /// Adds a flag with a value, or an argument.
    /// @param names  "-o,--output" for a flag, "SCENE" for an argument
    /// @param value  std::string, std::filesystem::path, int, double, std::optional of a number, or std::vector of
    ///               strings or whole numbers
    template <class Value>
    Flag option(const std::string& names, Value& value, const std::string& help) const;
    Flag flag(const std::string& names, bool& value, const std::string& help) const;

    /// Sets the end of the help: the notes, if there are any, then the example.
    void example(const std::string& text, const std::string& notes = "") const;
    void run(std::function<void()> action) const;
    /// Makes it an error to call the command without one of its subcommands.
    void needsCommand() const;
    /// Leaves the command out of the help, the man page and the completion.
    void hide() const;

    /// Adds a flag that prints a text and ends the program.
    void printingFlag(const std::string& name, const std::string& help, std::function<std::string()> text) const;

    /// The man page of the program, in roff's man macros. This and the completion are in command_docs.cpp.
    /// @pre the command is CommandLine::program()
    std::string manPage(const std::string& version) const;
    /// A script for bash that completes commands, flags, their values and scenes.
    /// @pre the command is CommandLine::program()
    std::string bashCompletion() const;

 private:
    CLI::App* app_;
};

/// Wrong flags; what() says which and why.
class UsageError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// The program itself.
class CommandLine {
 public:
    CommandLine(const std::string& name, const std::string& help);
    ~CommandLine();

    Command program() const;
    /// Runs the command that was called, or prints what --help or a printing flag asks for.
    /// @throws UsageError if there is no command or a flag is wrong, and whatever the command throws
    void run(int argc, char** argv) const;

 private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace tools
