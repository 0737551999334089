// Signals are handled with sigaction. A thread of its own ends the program in time where the work does not, such as a
// picture that takes seconds to draw.
#include "tools/system/interrupts.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <limits>
#include <thread>

#include "render/output/child_process.h"
#include "tools/system/process.h"

namespace tools {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

// Times in ns. Chosen: a run ends within two seconds of the first signal and within a tenth of the second one, with
// some time for the system to end it.
constexpr std::int64_t kEndAfterFirst = 1'850'000'000;  ///< from the first signal to the end
constexpr std::int64_t kEndAfterSecond = 70'000'000;    ///< from the second signal to the end
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

// What the signal handler reads and writes.
std::atomic<int> receivedSignal = 0;                 ///< the first signal, or 0
std::atomic<int> receivedCount = 0;                  ///< number of signals that were recorded
std::atomic<std::int64_t> firstTime = 0;             ///< when the first signal arrived, ns
std::atomic<std::int64_t> secondTime = 0;            ///< when the second signal arrived, ns
std::atomic<int> mostRecorded = 1;                   ///< number of signals to record before one ends the program
std::atomic<const char*> interruptNotice = nullptr;  ///< line to write when SIGINT arrives first, or nullptr
std::atomic<sem_t*> arrivals = nullptr;  ///< counts the signals for the thread that waits for them, or nullptr
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free && std::atomic<sem_t*>::is_always_lock_free,
              "a signal handler must not wait for a lock");

/// The time of a clock that never jumps, ns. Unlike those of std::chrono, it may be called in a signal handler.
std::int64_t monotonicTime() {
    timespec now = {};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

/// Sets the action of a signal, unless the signal is ignored: nohup and shells start a program so that it ignores what
/// is meant for a terminal. Returns the action that was set before.
struct sigaction replaceAction(int signal, void (*handler)(int)) {
    struct sigaction previous = {};
    ::sigaction(signal, nullptr, &previous);
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    if (previous.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    return previous;
}

void writeToErrors(const char* text) {
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// The signal handler. After the last signal that is recorded it restores the default actions, so that the next signal
/// ends the program.
void recordSignal(int signal) {
    const int previousError = errno;
    const int count = ++receivedCount;
    if (count == 1) {
        firstTime = monotonicTime();
        receivedSignal = signal;
        const char* const notice = interruptNotice;
        if (notice != nullptr && signal == SIGINT) writeToErrors(notice);
    }
    if (count == 2) secondTime = monotonicTime();
    if (count >= mostRecorded)
        for (const int each : kSignals) replaceAction(each, SIG_DFL);
    if (sem_t* const semaphore = arrivals) ::sem_post(semaphore);
    errno = previousError;
}

/// When the program must have ended, as the signals so far have it, ns; kNever without one.
std::int64_t endTime() {
    if (receivedSignal == 0) return kNever;
    const std::int64_t afterFirst = firstTime + kEndAfterFirst;
    return secondTime == 0 ? afterFirst : std::min(afterFirst, secondTime + kEndAfterSecond);
}

}  // namespace

/// The thread that ends the program where the work does not end in time.
class InterruptWatch::Deadline {
 public:
    explicit Deadline(const char* lastWords) : lastWords_(lastWords) {
        ::sem_init(&semaphore_, 0, 0);
        arrivals = &semaphore_;
        thread_ = std::thread([this] { wait(); });
    }
    ~Deadline() {
        isOver_ = true;
        arrivals = nullptr;
        ::sem_post(&semaphore_);
        thread_.join();
        ::sem_destroy(&semaphore_);
    }
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;

 private:
    void wait() {
        while (!isOver_) {
            const std::int64_t end = endTime();
            if (end == kNever) {
                ::sem_wait(&semaphore_);
            } else if (monotonicTime() >= end) {
                endProgram();
            } else {
                constexpr std::int64_t kSecond = 1'000'000'000;
                const timespec until = {end / kSecond, end % kSecond};
                ::sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until);
            }
        }
    }

    /// Ends the program without waiting for any thread. Files that are half written have names of their own, which the
    /// next run clears away.
    [[noreturn]] void endProgram() const {
        render::killChildProcesses();
        writeToErrors(lastWords_);
        ::_exit(kSignalExitBase + receivedSignal);
    }

    const char* lastWords_;
    sem_t semaphore_ = {};
    std::atomic<bool> isOver_ = false;
    std::thread thread_;
};

InterruptWatch::InterruptWatch(const InterruptOptions& options)
    : endsSoon_(options.endsSoon), graceTime_(static_cast<std::int64_t>(1e9 * options.graceSeconds)) {
    receivedSignal = 0;
    receivedCount = 0;
    secondTime = 0;
    mostRecorded = endsSoon_ ? 2 : 1;
    interruptNotice = options.notice;
    if (endsSoon_) deadline_ = std::make_unique<Deadline>(options.lastWords);
    for (std::size_t s = 0; s < kSignals.size(); ++s) previousActions_[s] = replaceAction(kSignals[s], recordSignal);
}

InterruptWatch::~InterruptWatch() {
    for (std::size_t s = 0; s < kSignals.size(); ++s) ::sigaction(kSignals[s], &previousActions_[s], nullptr);
}

int InterruptWatch::signal() const {
    return receivedSignal;
}

bool InterruptWatch::mustStop() const {
    if (!endsSoon_ || receivedSignal == 0) return false;
    return receivedCount > 1 || monotonicTime() - firstTime > graceTime_;
}

}  // namespace tools
