// What is wrong with what the user gave, as one error that carries every problem of a file. Thrown by the readers of
// this library; main prints one line per problem.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace scenes {

/// One mistake and where it stands. A line or column of 0 means that there is none to name.
struct Problem {
    std::string file;  ///< or the whole option, e.g. "--set physics.step=-1"
    int line = 0;
    int column = 0;
    std::string message;
};

/// "file:line:column: message", without what is 0.
std::string lineOf(const Problem& problem);

/// All problems of one file; what() has one line for each.
class InputError : public std::runtime_error {
 public:
    explicit InputError(std::vector<Problem> problems);

    const std::vector<Problem>& problems() const { return problems_; }

 private:
    std::vector<Problem> problems_;
};

}  // namespace scenes
