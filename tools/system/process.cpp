// Standard streams are written with the C library, whose error flags stay set until they are read. Signals are handled
// with sigaction.
#include "tools/system/process.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "render/picture/system_error.h"

namespace tools {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> receivedSignal = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler must not wait for a lock");

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

/// The signal handler. It restores the default actions, so that the next signal ends the program.
void recordSignal(int signal) {
    receivedSignal = signal;
    for (const int each : kSignals) replaceAction(each, SIG_DFL);
}

}  // namespace

void prepareStandardStreams() {
    for (const int descriptor : {0, 1, 2})
        if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);  // open() takes the lowest free descriptor
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void ensureTemporaryFolder() {
    constexpr const char* kFolder = "/tmp";
    if (std::error_code error; !std::filesystem::temp_directory_path(error).empty()) return;
    for (const char* name : {"TMPDIR", "TMP", "TEMP", "TEMPDIR"}) {  // in the order of temp_directory_path()
        const char* const folder = std::getenv(name);
        if (folder == nullptr) continue;
        printWarning(fmt::format("{} is \"{}\", which is no folder; temporary files go to {}", name, folder, kFolder));
        break;
    }
    ::setenv("TMPDIR", kFolder, 1);
}

void printToStderr(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

void printWarning(const std::string& message) {
    printToStderr("warning: " + message + "\n");
}

void flushStandardOutput() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    if (errno == EPIPE) throw ExitStatus(kReaderGoneCode, "");
    throw render::SystemError("cannot write to standard output");
}

InterruptWatch::InterruptWatch() {
    receivedSignal = 0;
    for (std::size_t s = 0; s < kSignals.size(); ++s) previousActions_[s] = replaceAction(kSignals[s], recordSignal);
}

InterruptWatch::~InterruptWatch() {
    for (std::size_t s = 0; s < kSignals.size(); ++s) ::sigaction(kSignals[s], &previousActions_[s], nullptr);
}

int InterruptWatch::signal() const {
    return receivedSignal;
}

}  // namespace tools
