// Problems with the user's input as lines of text.
#include "scenes/text/input_error.h"

#include <fmt/format.h>

#include <utility>

namespace scenes {
namespace {

std::string textOf(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
        if (!text.empty()) text += '\n';
        text += formatProblem(problem);
    }
    return text;
}

}  // namespace

std::string formatProblem(const Problem& problem) {
    if (problem.line == 0) return fmt::format("{}: {}", problem.file, problem.message);
    if (problem.column == 0) return fmt::format("{}:{}: {}", problem.file, problem.line, problem.message);
    return fmt::format("{}:{}:{}: {}", problem.file, problem.line, problem.column, problem.message);
}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(textOf(problems)), problems_(std::move(problems)) {}

InputError::InputError(const std::string& file, const std::string& message)
    : InputError(std::vector<Problem>{{file, 0, 0, message}}) {}

}  // namespace scenes
