// A child process with its input on a pipe and its output and errors in a temporary file. Used for ffmpeg by video.cpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace render {

/// Chosen: no frame takes an encoder as long, s, nor does the end of a long film.
inline constexpr std::chrono::duration<double> kProgressTimeout{120.0};

/// Of what takes as long as it takes and tells nothing on the way, s.
inline constexpr std::chrono::duration<double> kNoTimeout{1e6};

/// A running program. Its output goes to an unnamed file, because a pipe that nobody reads fills up and stops both
/// sides.
class ChildProcess {
 public:
    /// arguments[0] is the program, looked up on PATH; no shell is involved. A child that takes no input or does not
    /// end for longer than `patience` is killed. Throws SystemError when it cannot be started.
    explicit ChildProcess(const std::vector<std::string>& arguments,
                          std::chrono::duration<double> patience = kProgressTimeout);
    /// Kills the child if it still runs.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes everything to the child's input; false when the child no longer reads. Never raises SIGPIPE.
    bool write(std::span<const std::uint8_t> bytes);

    /// Closes the input, waits for the end, and says how it ended: empty for exit status 0, else "exit status 1",
    /// "signal 9 (...)" or "no sign of life for 120 s".
    std::string wait();

    /// What the child wrote to its output and errors; the end of it, at most so many bytes.
    std::string output(std::size_t most = 2000) const;

 private:
    void closeInput();
    void giveUp();

    std::chrono::duration<double> patience_;
    bool gaveUp_ = false;

    int input_ = -1;
    int log_ = -1;
    pid_t pid_ = -1;
};

}  // namespace render
