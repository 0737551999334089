// Formats the bar, the plain lines and the JSON lines of Progress.
#include "tools/system/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <utility>

#include "tools/system/json.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {
namespace {

using Seconds = std::chrono::duration<double>;

/// Time to the first plain line of progress and between two of them. Chosen: soon enough to see that a run has begun,
/// rare enough for a log file, often enough to show that work goes on.
constexpr Seconds kFirstLine{3.0};
constexpr Seconds kLineInterval{10.0};

/// Times between two drawings of the line on a terminal, for frames that follow each other and while none is completed.
/// Chosen: a terminal keeps up, and numbers can be read.
constexpr Seconds kFrameInterval{0.05};
constexpr Seconds kRefreshInterval{0.5};

/// Time after which work that is under way is shown. Chosen: most frames take less.
constexpr Seconds kLongWork{2.0};

constexpr int kFreeColumns = 4;
constexpr int kLongestTitle = 30;  ///< columns
constexpr int kShortestTitle = 8;  ///< columns to which a title may be cut; chosen: it can still be recognized
constexpr int kLongestBar = 30;
constexpr int kShortestBar = 5;

/// Width of the terminal on standard error.
int terminalColumns() {
    winsize size = {};
    constexpr int kUsual = 80;
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

std::string rateText(double rate) {
    return rate < 0.1 ? fmt::format("{:.2g} frames/s", rate) : fmt::format("{:.1f} frames/s", rate);
}

/// The minutes and seconds that are left if the rate (frames per second) stays what it has been.
std::string timeLeft(int frames, double rate) {
    const auto seconds = static_cast<std::int64_t>(frames / rate);
    return fmt::format("{}:{:02} left", seconds / 60, seconds % 60);
}

}  // namespace

std::string progressLine(const std::string& title, std::optional<double> share, std::vector<std::string> parts,
                         int columns) {
    const int room = std::max(1, columns - kFreeColumns);
    std::string text;
    for (;; parts.pop_back()) {
        text = fmt::format("{}", fmt::join(parts, ", "));
        if (parts.size() == 1 || std::ssize(text) <= room) break;
    }
    text = text.substr(0, static_cast<std::size_t>(room));
    int left = room - static_cast<int>(text.size()) - 1;
    FittedText name = fitColumns(title, std::min(left, kLongestTitle));
    if (name.text.size() < title.size() && name.columns < kShortestTitle) name = {};
    if (name.columns > 0) {
        text = name.text + " " + text;
        left -= name.columns + 1;
    }
    const int bar = std::min(left - 2, kLongestBar);  // without its brackets
    if (bar < kShortestBar || !share) return text;
    const int filled = static_cast<int>(bar * std::clamp(*share, 0.0, 1.0));
    const std::size_t place = name.columns > 0 ? name.text.size() + 1 : 0;
    return text.insert(place, fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", bar - filled));
}

Progress::Progress(std::string title, int total, Verbosity verbosity)
    : title_(std::move(title)),
      total_(total),
      verbosity_(verbosity),
      isTerminal_(isatty(STDERR_FILENO) == 1),
      lastLine_(Clock::now()) {
    if (verbosity_ != Verbosity::quiet) thread_ = std::thread([this] { showInTurn(); });
}

Progress::~Progress() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
    }
    ending_.notify_all();
    if (thread_.joinable()) thread_.join();
    if (verbosity_ == Verbosity::normal && isTerminal_ && hasLine_) printToStderr("\n");
}

void Progress::showInTurn() {
    std::unique_lock lock(mutex_);
    while (!ending_.wait_for(lock, kRefreshInterval, [this] { return isEnding_; })) {
        try {
            show(false);
        } catch (const std::exception&) {
            // The reader of standard output is gone. The next print of another thread fails for the same reason.
            return;
        }
    }
}

void Progress::frameDone(int frame, double sceneTime) {
    if (verbosity_ == Verbosity::quiet) return;
    const std::lock_guard lock(mutex_);
    ++done_.count;
    skippedTo_ = 0;
    if (verbosity_ == Verbosity::json) {
        lastLine_ = Clock::now();
        printJson({{"event", "frame"},
                   {"scene", title_},
                   {"frame", frame},
                   {"time", sceneTime},
                   {"done", done_.count},
                   {"total", total_}});
        return;
    }
    show(true);
}

void Progress::frameSkipped(int frame, double sceneTime, int wanted) {
    if (verbosity_ == Verbosity::quiet) return;
    const std::lock_guard lock(mutex_);
    // The first frame that is skipped starts the clock.
    if (std::exchange(skippedTo_, wanted) != wanted)
        skipped_ = {};
    else
        ++skipped_.count;
    lastSkipped_ = frame;
    if (done_.count == 0) done_.start = Clock::now();  // frames that are only simulated take another time
    if (verbosity_ == Verbosity::json) {
        lastLine_ = Clock::now();
        printJson({{"event", "simulated"}, {"scene", title_}, {"frame", frame}, {"time", sceneTime}});
        return;
    }
    show(true);
}

void Progress::hide() {
    const std::lock_guard lock(mutex_);
    if (verbosity_ == Verbosity::normal && isTerminal_ && std::exchange(hasLine_, false)) printOverLine("");
}

void Progress::stepBegins(double time) {
    const double previous = stepTime_.exchange(time, std::memory_order_relaxed);
    if (time > previous) stepLength_.store(time - previous, std::memory_order_relaxed);
}

/// Prints what there is to say, if it is time to.
/// @param isFrame  whether a frame has just been completed
/// @pre the mutex is held
void Progress::show(bool isFrame) {
    const auto now = Clock::now();
    const Seconds sinceLast = now - lastLine_;
    const bool isDrawn = verbosity_ == Verbosity::normal && isTerminal_;
    const Seconds interval = !isDrawn  ? (hasLine_ ? kLineInterval : kFirstLine)
                             : isFrame ? kFrameInterval
                                       : Seconds(0.0);
    const bool isLast = isDrawn && done_.count == total_;
    if (sinceLast < interval && !isLast && (hasLine_ || !isDrawn)) return;
    lastLine_ = now;
    hasLine_ = true;
    const std::vector<std::string> said = parts();
    const std::string all = fmt::format("{}", fmt::join(said, ", "));
    const std::optional<double> share =
        total_ > 0 ? std::optional(static_cast<double>(done_.count) / total_) : std::nullopt;
    if (isDrawn)
        printOverLine(progressLine(title_, share, said, terminalColumns()));
    else if (verbosity_ == Verbosity::normal)
        printToStderr(fmt::format("{}: {}\n", title_, all));
    else
        printJson({{"event", "working"}, {"scene", title_}, {"doing", all}, {"done", done_.count}, {"total", total_}});
}

/// What there is to say, the most important first.
/// @pre the mutex is held
std::vector<std::string> Progress::parts() const {
    const bool isSkipping = skippedTo_ > 0;
    const Pace& pace = isSkipping ? skipped_ : done_;
    std::vector<std::string> parts;
    if (isSkipping)
        parts.push_back(fmt::format("simulating, frame {} of {}", lastSkipped_, skippedTo_));
    else if (done_.count == 0 && works_.empty())
        parts.emplace_back("starting");
    else if (total_ > 0)
        parts.push_back(fmt::format("{}/{}", done_.count, total_));
    else
        parts.push_back(fmt::format("{} done", done_.count));
    for (const Work* work : works_)
        if (Clock::now() - work->start_ >= kLongWork) parts.push_back(textOf(*work));
    if (pace.count == 0 || total_ == 0) return parts;
    const double rate = pace.count / std::max(1e-6, Seconds(Clock::now() - pace.start).count());
    parts.push_back(rateText(rate));
    if (!isSkipping) parts.push_back(timeLeft(total_ - done_.count, rate));
    return parts;
}

std::string Progress::textOf(const Work& work) const {
    if (work.to_ == work.from_)
        return fmt::format("{} for {:.0f} s", work.what_, Seconds(Clock::now() - work.start_).count());
    // Trial runs, which estimate the error of a frame, begin at the start of the frame again and may go beyond its end.
    const double share = std::clamp((stepTime_ - work.from_) / (work.to_ - work.from_), 0.0, 1.0);
    const std::string text = fmt::format("{}, {:.3g} % of its time", work.what_, 100.0 * share);
    return stepLength_ == 0.0 ? text : fmt::format("{}, steps of {:.1g} s", text, stepLength_.load());
}

Progress::Work::Work(Progress& progress, std::string what) : Work(progress, std::move(what), 0.0, 0.0) {}

Progress::Work::Work(Progress& progress, std::string what, double from, double to)
    : progress_(progress), what_(std::move(what)), from_(from), to_(to) {
    const std::lock_guard lock(progress_.mutex_);
    progress_.works_.push_back(this);
    if (to_ == from_) return;
    progress_.stepTime_ = from_;
    progress_.stepLength_ = 0.0;
}

Progress::Work::~Work() {
    const std::lock_guard lock(progress_.mutex_);
    std::erase(progress_.works_, this);
}

}  // namespace tools
