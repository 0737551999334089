// A command that has exit codes of its own.
#pragma once

#include <stdexcept>
#include <string>

namespace tools {

/// Thrown by a command to end the program with this code. The message is printed as an error; empty: nothing is.
class Ended : public std::runtime_error {
 public:
    Ended(int exitCode, const std::string& message) : std::runtime_error(message), exitCode_(exitCode) {}
    int exitCode() const { return exitCode_; }

 private:
    int exitCode_;
};

}  // namespace tools
