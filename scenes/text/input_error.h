// The exception for everything that is wrong with the user's input. It carries all problems of a file at once; main
// prints one line for each.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace scenes {

/// One mistake and its position. Line and column count from 1; 0 means that there is no line or column to name.
struct Problem {
    std::string file;  ///< the file, or the command-line option, e.g. "--set physics.step=-1"
    int line = 0;
    int column = 0;
    std::string message;
};

/// "file:line:column: message"; a line or column of 0 is left out.
std::string formatProblem(const Problem& problem);

/// All problems of one file; what() has one line for each problem.
class InputError : public std::runtime_error {
 public:
    explicit InputError(std::vector<Problem> problems);
    /// A single problem that has no line.
    /// @param file  the file, or the command-line option
    InputError(const std::string& file, const std::string& message);

    const std::vector<Problem>& problems() const { return problems_; }

 private:
    std::vector<Problem> problems_;
};

}  // namespace scenes
