// The command line: commands with their flags, help, and what they do. CLI11 stays behind this, in one file: its
// classes are compiled anew wherever they are included, which was most of what the subcommands took to compile.
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
    /// Shape: what stands for the value in the help, as in "DIR".
    Flag& of(const std::string& placeholder);
    /// The value lies in [least, most].
    Flag& within(int least, int most);
    Flag& within(double least, double most);
    Flag& atLeastZero();
    Flag& aboveZero();
    Flag& oneOf(const std::vector<std::string>& names);
    /// Given again for each further value: --set A --set B.
    Flag& oneAtATime();
    Flag& showDefault();
    Flag& notWith(const Flag& other);

 private:
    CLI::Option* option_;
};

/// A command or subcommand. What its flags are read into has to live until it is run.
class Command {
 public:
    explicit Command(CLI::App& app) : app_(&app) {}

    Command command(const std::string& name, const std::string& help) const;

    /// Shape: names as in "-o,--output", or "SCENE" for an argument; value: std::string, std::filesystem::path, int,
    /// double, std::optional of a number, or std::vector of strings or whole numbers.
    template <class Value>
    Flag option(const std::string& names, Value& value, const std::string& help) const;
    Flag flag(const std::string& names, bool& value, const std::string& help) const;

    /// The end of the help: notes, if there are any, then the example.
    void example(const std::string& text, const std::string& notes = "") const;
    void run(std::function<void()> action) const;
    /// It is nothing without one of its subcommands.
    void needsCommand() const;

 private:
    CLI::App* app_;
};

/// Flags that are wrong; what() says which and why.
class UsageError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// The program itself.
class CommandLine {
 public:
    CommandLine(const std::string& name, const std::string& help, const std::string& version);
    ~CommandLine();

    Command program() const;
    /// Runs the command that was called. Returns whether there was one (or help or version were asked for and printed).
    /// Errors: UsageError; whatever the command throws.
    bool run(int argc, char** argv) const;

 private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace tools
