// Progress to stderr, or JSON lines to stdout.
#include "tools/system/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/system/json.h"
#include "tools/system/standard_streams.h"

namespace tools {
namespace {

/// Chosen: seldom enough for a log file, often enough to see that it is alive, s.
constexpr double kLineInterval = 10.0;
constexpr int kBarWidth = 30;

/// Minutes and seconds left at the rate so far.
std::string timeLeft(int done, int total, double elapsed) {
    const int seconds = static_cast<int>(elapsed / done * (total - done));
    return fmt::format("{}:{:02} left", seconds / 60, seconds % 60);
}

}  // namespace

Progress::Progress(std::string title, int total, Verbosity verbosity)
    : title_(std::move(title)),
      total_(total),
      verbosity_(verbosity),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (verbosity_ == Verbosity::normal && terminal_ && done_ > 0) printToStderr("\n");
}

void Progress::frameDone(int frame, double sceneTime) {
    ++done_;
    if (verbosity_ == Verbosity::quiet) return;
    if (verbosity_ == Verbosity::json) {
        const Json line = {{"event", "frame"},  {"scene", title_}, {"frame", frame},
                           {"time", sceneTime}, {"done", done_},   {"total", total_}};
        printJson(line);
        return;
    }
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (terminal_)
        drawBar(elapsed);
    else if (elapsed - lastLine_ >= kLineInterval)
        printLine(elapsed);
}

void Progress::drawBar(double elapsed) const {
    const int filled = kBarWidth * done_ / total_;
    printToStderr(fmt::format("\r{} [{:#<{}}{:.<{}}] {}/{} {:.1f} frames/s, {} ", title_, "", filled, "",
                              kBarWidth - filled, done_, total_, done_ / elapsed, timeLeft(done_, total_, elapsed)));
}

void Progress::printLine(double elapsed) {
    lastLine_ = elapsed;
    printToStderr(fmt::format("{}: frame {} of {}, {:.1f} frames/s, {}\n", title_, done_, total_, done_ / elapsed,
                              timeLeft(done_, total_, elapsed)));
}

}  // namespace tools
