// Formats the bar, the plain lines and the JSON lines of Progress.
#include "tools/system/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>

#include "tools/system/json.h"
#include "tools/system/process.h"

namespace tools {
namespace {

/// Time between two plain lines of progress, in seconds. Chosen: rare enough for a log file, often enough to show that
/// work goes on.
constexpr double kLineInterval = 10.0;
constexpr std::int64_t kBarWidth = 30;

/// The minutes and seconds that are left if the rate stays what it has been, as text.
std::string timeLeft(int done, int total, double elapsed) {
    const int seconds = static_cast<int>(elapsed / done * (total - done));
    return fmt::format("{}:{:02} left", seconds / 60, seconds % 60);
}

}  // namespace

Progress::Progress(std::string title, int total, Verbosity verbosity)
    : title_(std::move(title)),
      total_(total),
      verbosity_(verbosity),
      isTerminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (verbosity_ == Verbosity::normal && isTerminal_ && doneCount_ > 0) printToStderr("\n");
}

void Progress::frameDone(int frame, double sceneTime) {
    ++doneCount_;
    if (verbosity_ == Verbosity::quiet) return;
    if (verbosity_ == Verbosity::json) {
        const Json line = {{"event", "frame"},  {"scene", title_},    {"frame", frame},
                           {"time", sceneTime}, {"done", doneCount_}, {"total", total_}};
        printJson(line);
        return;
    }
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::string rate =
        fmt::format("{:.1f} frames/s, {}", doneCount_ / elapsed, timeLeft(doneCount_, total_, elapsed));
    if (isTerminal_) {
        const std::int64_t filled = kBarWidth * doneCount_ / total_;
        printToStderr(fmt::format("\r{} [{:#<{}}{:.<{}}] {}/{} {} ", title_, "", filled, "", kBarWidth - filled,
                                  doneCount_, total_, rate));
    } else if (elapsed - lastLineSeconds_ >= kLineInterval) {
        lastLineSeconds_ = elapsed;
        printToStderr(fmt::format("{}: frame {} of {}, {}\n", title_, doneCount_, total_, rate));
    }
}

}  // namespace tools
