// A command that has exit codes of its own.
#pragma once

#include <csignal>
#include <stdexcept>
#include <string>

namespace tools {

/// As shells have it for a program that a closed pipe ends.
inline constexpr int kReaderGoneCode = 128 + SIGPIPE;

/// Thrown by a command to end the program with this code. The message is printed as an error; empty: nothing is.
class ExitStatus : public std::runtime_error {
 public:
    ExitStatus(int exitCode, const std::string& message) : std::runtime_error(message), exitCode_(exitCode) {}
    int code() const { return exitCode_; }

 private:
    int exitCode_;
};

}  // namespace tools
