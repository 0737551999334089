// Work with a time limit that holds whatever the work does: it runs in a child process, which the system ends when the
// time is up. Used by `check`, which has to answer soon also where a single time step takes minutes.
#pragma once

#include <functional>
#include <string>

#include "tools/system/json.h"

namespace tools {

/// Hands the members of a JSON object to the parent process; a member replaces an earlier one of that name.
using Report = std::function<void(const Json&)>;

/// Runs work(report) in a child process for at most so many seconds of wall-clock time, and returns all members that it
/// has reported by then. The program must not have started a thread before, because a child process has none but the
/// calling one.
/// @throws render::SystemError if the work throws, with its message, or if the child process ends otherwise
Json runInChild(unsigned seconds, const std::function<void(const Report&)>& work);

}  // namespace tools
