// Order and wording of the places that problems name.
#include "scenes/text/problem_list.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace scenes {
namespace {

/// More than anyone reads at once; bounds the work on a file that is no scene at all.
constexpr std::size_t kMostProblems = 200;

}  // namespace

ProblemList::ProblemList(std::string file, Overrides overrides)
    : file_(std::move(file)), overrides_(std::move(overrides)) {}

void ProblemList::add(const Position& at, std::string message) {
    if (entries_.size() == kMostProblems) {
        more_ = true;
        return;
    }
    const auto same = [&](const Located& entry) {
        return entry.at.line == at.line && entry.at.column == at.column && entry.at.overrideIndex == at.overrideIndex &&
               entry.message == message;
    };
    if (std::any_of(entries_.begin(), entries_.end(), same)) return;
    entries_.push_back({at, std::move(message)});
}

void ProblemList::add(const Position& at, const InputError& error) {
    for (const Problem& problem : error.problems()) add(at, lineOf(problem));
}

void ProblemList::throwIfAny() const {
    if (entries_.empty()) return;
    std::vector<Located> sorted = entries_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Located& a, const Located& b) {
        return std::tie(a.at.overrideIndex, a.at.line, a.at.column) <
               std::tie(b.at.overrideIndex, b.at.line, b.at.column);
    });
    std::vector<Problem> problems;
    for (const Located& entry : sorted) {
        if (entry.at.overrideIndex < 0)
            problems.push_back({file_, entry.at.line, entry.at.column, entry.message});
        else
            problems.push_back(
                {overrides_.at(static_cast<std::size_t>(entry.at.overrideIndex)).flag, 0, 0, entry.message});
    }
    if (more_) problems.push_back({file_, 0, 0, "there are more problems than are shown here"});
    throw InputError(std::move(problems));
}

}  // namespace scenes
