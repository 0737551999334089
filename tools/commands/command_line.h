// What the program adds to CLI11: checks of numbers, and messages that suggest the nearest known name.
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>

namespace tools {

/// Checks that the value of a flag is a finite number: from least to most, both included, at least 0, or above 0.
/// CLI11's own checks accept NaN and infinity, and their messages name the largest double as the upper bound.
CLI::Validator numberFrom(double least, double most);
CLI::Validator numberAtLeastZero();
CLI::Validator numberAboveZero();

/// Thrown for a wrong command line; what() says which word is wrong and why.
class UsageError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// Runs the command that was called, or prints what --help or another flag of the program asks for.
/// @throws UsageError if there is no command or a flag is wrong, and whatever the command throws
void runCommandLine(CLI::App& program, int argc, char** argv);

}  // namespace tools
