// A forked process that writes one line of JSON for each report into a pipe, and an alarm that ends the process.
#include "tools/system/timed_child.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>

#include "render/picture/system_error.h"

namespace tools {
namespace {

/// The member that the message of an exception is reported as.
constexpr const char* kError = "error of the child process";

void writeLine(int descriptor, const Json& values) {
    const std::string line = compactText(values) + "\n";
    for (std::size_t written = 0; written < line.size();) {
        const ssize_t count = ::write(descriptor, line.data() + written, line.size() - written);
        if (count < 0 && errno != EINTR) ::_exit(1);  // the parent is gone
        if (count > 0) written += static_cast<std::size_t>(count);
    }
}

/// What the child process does. It ends without destructors and without flushing the parent's output once more.
[[noreturn]] void runChild(int descriptor, unsigned seconds, const std::function<void(const Report&)>& work) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // no child outlives a parent that is killed
    std::signal(SIGALRM, SIG_DFL);
    ::alarm(seconds);
    try {
        work([&](const Json& values) { writeLine(descriptor, values); });
    } catch (const std::exception& error) {
        writeLine(descriptor, {{kError, error.what()}});
    }
    ::_exit(0);
}

std::string readAll(int descriptor) {
    std::string text;
    std::array<char, 4096> buffer;
    while (true) {
        const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
        if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) return text;
    }
}

Json parseLines(const std::string& text) {
    Json values = Json::object();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const Json reported = Json::parse(line, nullptr, false);
        if (reported.is_object()) values.update(reported);  // the last line may be cut
    }
    return values;
}

/// Waits for the end of a process, which is to end by itself or by its alarm.
void awaitEnd(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFSIGNALED(status) || WTERMSIG(status) == SIGALRM) return;
    throw render::SystemError(fmt::format("the process that tries the scene was ended by signal {} ({}){}",
                                          WTERMSIG(status), ::strsignal(WTERMSIG(status)),
                                          WTERMSIG(status) == SIGKILL ? "; is there enough memory?" : ""));
}

}  // namespace

Json runInChild(unsigned seconds, const std::function<void(const Report&)>& work) {
    std::array<int, 2> ends = {};
    if (::pipe(ends.data()) != 0)
        throw render::SystemError(fmt::format("cannot open a pipe: {}", std::strerror(errno)));
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        runChild(ends[1], seconds, work);
    }
    const int forkError = errno;
    ::close(ends[1]);
    const std::string text = readAll(ends[0]);
    ::close(ends[0]);
    if (child < 0) throw render::SystemError(fmt::format("cannot start a process: {}", std::strerror(forkError)));
    awaitEnd(child);
    Json values = parseLines(text);
    if (values.contains(kError)) throw render::SystemError(values[kError].get<std::string>());
    return values;
}

}  // namespace tools
