// Standard streams are written with the C library, whose error flags stay set until they are read. Signals are handled
// with sigaction.
#include "tools/system/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <system_error>

#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/system/text.h"

namespace tools {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

/// How long after a SIGTERM or SIGHUP the present frame may take, ns. Chosen: half of the 10 s after which `docker
/// stop` kills.
constexpr std::int64_t kGraceTime = 5'000'000'000;

// What the signal handler reads and writes.
std::atomic<int> receivedSignal = 0;                 ///< the first signal, or 0
std::atomic<int> receivedCount = 0;                  ///< number of signals that were recorded
std::atomic<std::int64_t> receivedTime = 0;          ///< when the first signal arrived, ns
std::atomic<int> mostRecorded = 1;                   ///< number of signals to record before one ends the program
std::atomic<const char*> interruptNotice = nullptr;  ///< line to write when SIGINT arrives first, or nullptr
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free &&
                  std::atomic<const char*>::is_always_lock_free,
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

/// The signal handler. After the last signal that is recorded it restores the default actions, so that the next signal
/// ends the program.
void recordSignal(int signal) {
    const int previousError = errno;
    if (receivedCount == 0) {
        receivedTime = monotonicTime();
        receivedSignal = signal;
        const char* const notice = interruptNotice;
        if (notice != nullptr && signal == SIGINT) {
            [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, notice, std::strlen(notice));
        }
    }
    if (++receivedCount >= mostRecorded)
        for (const int each : kSignals) replaceAction(each, SIG_DFL);
    errno = previousError;
}

/// Writes text as it is, with the commands to the terminal in it.
void writeToStderr(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

[[noreturn]] void failToPrint(int error) {
    if (error == EPIPE) throw ExitStatus(kReaderGoneCode, "");
    throw render::SystemError("cannot write to standard output");
}

}  // namespace

void prepareStandardStreams() {
    for (const int descriptor : {0, 1, 2})
        if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);  // open() takes the lowest free descriptor
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
    std::signal(SIGCHLD, SIG_DFL);  // an ignored SIGCHLD is inherited, and then no exit status of a child can be read
}

void ensureTemporaryFolder() {
    constexpr const char* kFolder = "/tmp";
    std::error_code error;
    if (std::filesystem::is_directory(std::filesystem::temp_directory_path(error), error)) return;
    for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {  // in the order of temp_directory_path()
        const char* const folder = std::getenv(name);
        if (folder == nullptr) continue;
        printWarning(fmt::format("{} is \"{}\", which is no folder; temporary files go to {}", name, folder, kFolder));
        break;
    }
    ::setenv("TMPDIR", kFolder, 1);
}

void printText(const std::string& text) {
    fmt::print("{}", printable(text));
}

void printJson(const Json& json) {
    printText(compactText(json) + "\n");
    flushStandardOutput();
}

void printToStderr(const std::string& text) {
    writeToStderr(printable(text));
}

void printOverLine(const std::string& text) {
    // "Erase to the end of the line" removes what a longer line has left there.
    writeToStderr("\r" + printable(text) + "\x1b[K");
}

void printWarning(const std::string& message) {
    // On a terminal the warning replaces the line of progress, which is drawn again below.
    const char* const start = isatty(STDERR_FILENO) == 1 ? "\r\x1b[K" : "";
    writeToStderr(fmt::format("{}warning: {}\n", start, printable(message)));
}

std::string readStandardInput(std::size_t limit) {
    std::string text;
    std::array<char, 65536> block;
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), stdin)) {
        text.append(block.data(), count);
        if (text.size() > limit)
            throw scenes::InputError("<stdin>", fmt::format("cannot be read: it is larger than {} MiB", limit >> 20U));
    }
    if (std::ferror(stdin) != 0)
        throw scenes::InputError("<stdin>", fmt::format("cannot be read: {}", std::strerror(errno)));
    return text;
}

void writeStandardOutput(std::span<const std::uint8_t> bytes) {
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) failToPrint(errno);
    flushStandardOutput();
}

void flushStandardOutput() {
    errno = 0;
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) failToPrint(errno);
}

InterruptWatch::InterruptWatch(int recordedCount, const char* notice) {
    receivedSignal = 0;
    receivedCount = 0;
    mostRecorded = recordedCount;
    interruptNotice = notice;
    for (std::size_t s = 0; s < kSignals.size(); ++s) previousActions_[s] = replaceAction(kSignals[s], recordSignal);
}

InterruptWatch::~InterruptWatch() {
    for (std::size_t s = 0; s < kSignals.size(); ++s) ::sigaction(kSignals[s], &previousActions_[s], nullptr);
}

int InterruptWatch::signal() const {
    return receivedSignal;
}

bool InterruptWatch::mustStop() const {
    const int signal = receivedSignal;
    if (signal == 0) return false;
    return receivedCount > 1 || (signal != SIGINT && monotonicTime() - receivedTime > kGraceTime);
}

}  // namespace tools
