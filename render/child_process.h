// A child process with its input on a pipe and its output and errors in a temporary file. Used for ffmpeg by video.cpp.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace render {

/// A running program. Its output goes to an unnamed file, because a pipe that nobody reads fills up and stops both
/// sides.
class ChildProcess {
 public:
    /// arguments[0] is the program, looked up on PATH; no shell is involved. Throws SystemError when it cannot be
    /// started.
    explicit ChildProcess(const std::vector<std::string>& arguments);
    /// Kills the child if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes everything to the child's input; false when the child no longer reads. Never raises SIGPIPE.
    bool write(std::span<const std::uint8_t> bytes);

    /// Closes the input, waits for the end, and says how it ended: empty for exit status 0, else "exit status 1" or
    /// "signal 9 (...)".
    std::string wait();

    /// What the child wrote to its output and errors; the end of it, at most so many bytes.
    std::string output(std::size_t most = 2000) const;

 private:
    void closeInput();

    int input_ = -1;
    int log_ = -1;
    pid_t pid_ = -1;
};

}  // namespace render
