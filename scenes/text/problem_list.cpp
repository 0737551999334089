// Collects problems, then sorts them by position and names the file or command-line option that each is in.
#include "scenes/text/problem_list.h"

#include <algorithm>
#include <utility>

namespace scenes {
namespace {

/// Largest number of problems that are kept. Chosen: more than are useful at once. The limit bounds the work on a file
/// that is not a scene at all.
constexpr std::size_t kMaxProblems = 200;

}  // namespace

ProblemList::ProblemList(std::string file, Overrides overrides)
    : file_(std::move(file)), overrides_(std::move(overrides)) {}

void ProblemList::add(const SourcePosition& position, std::string message) {
    if (items_.size() == kMaxProblems) {
        isTruncated_ = true;
        return;
    }
    const auto isSame = [&](const Item& item) { return item.position == position && item.message == message; };
    if (std::any_of(items_.begin(), items_.end(), isSame)) return;
    items_.push_back({position, std::move(message)});
}

void ProblemList::add(const SourcePosition& position, const InputError& error) {
    for (const Problem& problem : error.problems()) add(position, formatProblem(problem));
}

std::vector<Problem> ProblemList::sorted() const {
    std::vector<Item> items = items_;
    std::ranges::stable_sort(items, {}, &Item::position);
    std::vector<Problem> problems;
    for (const Item& item : items) {
        if (item.position.overrideIndex < 0)
            problems.push_back({file_, item.position.line, item.position.column, item.message});
        else
            problems.push_back(
                {overrides_.at(static_cast<std::size_t>(item.position.overrideIndex)).option, 0, 0, item.message});
    }
    if (isTruncated_) problems.push_back({file_, 0, 0, "there are more problems than are shown here"});
    return problems;
}

void ProblemList::throwIfAny() const {
    if (!items_.empty()) throw InputError(sorted());
}

}  // namespace scenes
