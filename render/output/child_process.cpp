// The child process is started by posix_spawn. Its input is a socket, because send() with MSG_NOSIGNAL returns an error
// code when the child has ended, where write() to a pipe would raise SIGPIPE.
#include "render/output/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <thread>
#include <utility>

#include <fmt/format.h>

extern char** environ;

namespace render {

namespace {

/// The process groups of the running programs; 0 where there is none. More programs than places are not recorded.
std::array<std::atomic<pid_t>, 16> runningGroups = {};

void replaceGroup(pid_t before, pid_t after) {
    for (std::atomic<pid_t>& group : runningGroups) {
        pid_t expected = before;
        if (group.compare_exchange_strong(expected, after)) return;
    }
}

std::string messageOf(int error) {
    return std::generic_category().message(error);
}

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

/// Creates a temporary file that has no name any more: it lasts until it is closed.
int unnamedFile() {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::temp_directory_path(ignored);
    if (ignored) folder = "/tmp";
    std::string name = (folder / "globular-XXXXXX").string();
    const int file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file < 0)
        throw SystemError(fmt::format("cannot create a temporary file in {}: {}", folder.string(), messageOf(errno)));
    ::unlink(name.c_str());
    return file;
}

/// The standard streams of a child process.
struct Streams {
    int input = -1;
    int output = -1;
    int errors = -1;
};

/// Starts the child process with the file descriptors 0, 1 and 2 only, because all others are opened with O_CLOEXEC.
/// Returns an errno value.
int spawn(const std::vector<std::string>& arguments, const Streams& streams, pid_t& pid) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, streams.input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, streams.output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, streams.errors, STDERR_FILENO);
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    // The child gets a process group of its own: a signal that the terminal sends, such as SIGINT, must not reach the
    // child, because this process decides what to do about the signal.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes, 0);
    // The child would ignore these signals as this process does, unless they are reset to their defaults.
    sigset_t ignored;
    sigemptyset(&ignored);
    sigaddset(&ignored, SIGPIPE);
    sigaddset(&ignored, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &ignored);
    const int error = ::posix_spawnp(&pid, pointers[0], &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, std::chrono::duration<double> progressTimeout,
                           std::string outputPath, StandardOutput standardOutput)
    : progressTimeout_(progressTimeout), outputPath_(std::move(outputPath)) {
    log_ = unnamedFile();
    std::array<int, 2> ends{-1, -1};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        const std::string reason = messageOf(errno);
        ::close(log_);
        throw SystemError(fmt::format("cannot create a socket pair for {}: {}", arguments.front(), reason));
    }
    input_ = ends[0];
    // A socket carries bytes both ways.
    const int output = standardOutput == StandardOutput::piped ? ends[1] : log_;
    const int error = spawn(arguments, {ends[1], output, log_}, pid_);
    ::close(ends[1]);
    if (error == 0) {
        replaceGroup(0, pid_);
        return;
    }
    ::close(input_);
    ::close(log_);
    const std::string message = fmt::format("cannot start {}: {}", arguments.front(), messageOf(error));
    if (error == ENOENT) throw ProgramMissing(message);
    throw SystemError(message);
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        ::kill(-pid_, SIGKILL);
        wait();
    }
    closeInput();
    ::close(log_);
}

void ChildProcess::closeInput() {
    if (input_ >= 0) ::close(input_);
    input_ = -1;
}

ChildProcess::Progress ChildProcess::progress() const {
    Progress now;
    clockid_t clock = 0;
    timespec used = {};
    if (::clock_getcpuclockid(pid_, &clock) == 0 && ::clock_gettime(clock, &used) == 0)
        now.processorTime = nanoseconds(used);
    struct stat output = {};
    if (!outputPath_.empty() && ::stat(outputPath_.c_str(), &output) == 0) {
        now.outputSize = output.st_size;
        now.outputTime = nanoseconds(output.st_mtim);
    }
    return now;
}

void ChildProcess::startWatch() {
    lastProgress_ = progress();
    lastLook_ = std::chrono::steady_clock::now();
    silence_ = {};
}

std::chrono::milliseconds ChildProcess::lookInterval() const {
    using std::chrono::milliseconds;
    const milliseconds longest(mustStop_ ? 20 : 1000);  // chosen: a stop is answered within a tenth of a second
    return std::clamp(std::chrono::duration_cast<milliseconds>(progressTimeout_ / 4), milliseconds(1), longest);
}

void ChildProcess::killIfStalled() {
    if (progress() != lastProgress_) return startWatch();
    const auto now = std::chrono::steady_clock::now();
    // Where much more time than the interval has passed since the last look, this process did not run either: both
    // processes were stopped, for example by `docker pause`. That time is not the child's.
    silence_ += std::min<std::chrono::duration<double>>(now - lastLook_, lookInterval());
    lastLook_ = now;
    if (hasStalled_ || silence_ <= progressTimeout_) return;
    hasStalled_ = true;
    ::kill(-pid_, SIGKILL);  // kills the whole process group of the child
}

/// Returns whether the program has been stopped.
bool ChildProcess::killIfStopped() {
    if (isStopped_ || !mustStop_ || !mustStop_()) return isStopped_;
    isStopped_ = true;
    ::kill(-pid_, SIGKILL);
    return true;
}

bool ChildProcess::write(std::span<const std::uint8_t> bytes) {
    startWatch();
    while (!bytes.empty()) {
        pollfd end = {input_, POLLOUT, 0};
        const int ready = ::poll(&end, 1, static_cast<int>(lookInterval().count()));
        if (ready < 0 && errno != EINTR) return false;
        if (ready == 0) killIfStalled();
        if (hasStalled_ || killIfStopped()) return false;
        if (ready <= 0) continue;
        const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (sent < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
        startWatch();  // the child has taken data
    }
    return true;
}

std::size_t ChildProcess::read(std::span<std::uint8_t> bytes, const std::function<void()>& whileWaiting) {
    constexpr int kInterval = 100;  // ms
    std::size_t count = 0;
    startWatch();
    while (count < bytes.size() && input_ >= 0 && !hasStalled_) {
        whileWaiting();
        pollfd end = {input_, POLLIN, 0};
        const int ready = ::poll(&end, 1, kInterval);
        if (ready < 0 && errno != EINTR) break;
        if (ready == 0) killIfStalled();
        if (ready <= 0) continue;
        const ssize_t received = ::recv(input_, bytes.data() + count, bytes.size() - count, 0);
        if (received < 0 && errno == EINTR) continue;
        if (received <= 0) break;
        count += static_cast<std::size_t>(received);
    }
    return count;
}

std::string ChildProcess::wait() {
    closeInput();
    if (pid_ <= 0) return "no such process any more";  // waitpid(-1) would wait for any other child
    int status = 0;
    startWatch();
    while (true) {
        const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
        if (ended == pid_) break;
        if (ended < 0 && errno != EINTR) return fmt::format("no exit status: {}", messageOf(errno));
        killIfStopped();
        killIfStalled();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    replaceGroup(pid_, 0);
    pid_ = -1;
    if (isStopped_) return "stopped";
    if (hasStalled_) return fmt::format("no progress for {:g} s", progressTimeout_.count());
    if (WIFSIGNALED(status)) return fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
    return WEXITSTATUS(status) == 0 ? std::string() : fmt::format("exit status {}", WEXITSTATUS(status));
}

std::string ChildProcess::firstLine() const {
    std::string text(1000, '\0');  // longer than any line that says what a program has
    const ssize_t got = ::pread(log_, text.data(), text.size(), 0);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    return text.substr(0, text.find('\n'));
}

std::string ChildProcess::output(std::size_t most) const {
    const off_t size = ::lseek(log_, 0, SEEK_END);
    std::string text(std::min(most, static_cast<std::size_t>(std::max<off_t>(size, 0))), '\0');
    const ssize_t got = ::pread(log_, text.data(), text.size(), size - static_cast<off_t>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

void killChildProcesses() {
    for (const std::atomic<pid_t>& group : runningGroups)
        if (const pid_t id = group; id > 0) ::kill(-id, SIGKILL);
}

}  // namespace render
