// Runs another program with its input on a socket and its output and errors in a temporary file, or its output on the
// socket too: ffmpeg for video.cpp and video_reader.cpp, and LAMMPS for the scaling study.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/system_error.h"

namespace render {

/// How long a child process may make no progress before it is killed, s. Chosen: no frame and no flush of a full disk
/// cache blocks a video encoder for as long.
inline constexpr std::chrono::duration<double> kProgressTimeout{120.0};

/// How long a child process that may sleep for any time may make no progress before it is killed, s.
inline constexpr std::chrono::duration<double> kNoTimeout{1e6};

/// Thrown for a program that is not installed, so that callers can say what to install.
class ProgramMissing : public SystemError {
 public:
    using SystemError::SystemError;
};

/// Where a program's standard output goes: with its errors to the unnamed file whose end output() returns, or to
/// read().
enum class StandardOutput { logged, piped };

/// A running program. Its errors go to an unnamed file, and so does its output unless it is read, because a pipe that
/// is not read would fill up and block both processes.
class ChildProcess {
 public:
    /// Starts a program without a shell. The program is killed when it makes no progress for `progressTimeout` while
    /// write(), read() or wait() wait for it. It makes progress while it uses processor time, takes input, or its
    /// output file changes. Time in which this process was stopped does not count.
    /// @param arguments  arguments[0] is the program, looked up on PATH
    /// @param outputPath  the file that the program writes; empty if there is none to watch
    /// @throws ProgramMissing when there is no such program
    /// @throws SystemError when the program cannot be started for another reason
    explicit ChildProcess(const std::vector<std::string>& arguments,
                          std::chrono::duration<double> progressTimeout = kProgressTimeout, std::string outputPath = {},
                          StandardOutput standardOutput = StandardOutput::logged);
    /// Kills the child if it is still running.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Kills the program as soon as a condition holds while write() or wait() wait for it. wait() then says "stopped".
    /// @param mustStop  called often
    void stopWhen(std::function<bool()> mustStop) { mustStop_ = std::move(mustStop); }

    /// Writes all bytes to the child's input. Returns false when the child no longer reads. Never raises SIGPIPE.
    bool write(std::span<const std::uint8_t> bytes);

    /// Fills `bytes` from the child's piped standard output. Returns how many bytes were read: fewer than wanted only
    /// when the child has closed its output.
    /// @param whileWaiting  called at least ten times a second; ends the wait by throwing
    std::size_t read(std::span<std::uint8_t> bytes, const std::function<void()>& whileWaiting);

    /// Closes the input, waits for the end of the program, and says how it ended: empty for exit status 0, otherwise
    /// for example "exit status 1", "signal 9 (Killed)" or "no progress for 120 s".
    std::string wait();

    /// The first line of what output() returns the end of.
    std::string firstLine() const;

    /// The end of what the program has written to its errors and, unless that is piped, its output, at most `most`
    /// bytes.
    std::string output(std::size_t most = 2000) const;

 private:
    /// Quantities of which at least one changes while the program makes progress.
    struct Progress {
        std::int64_t processorTime = 0;  ///< ns
        std::int64_t outputSize = 0;     ///< bytes
        std::int64_t outputTime = 0;     ///< time of the last change of the output file, ns

        bool operator==(const Progress&) const = default;
    };

    void closeInput();
    Progress progress() const;
    void startWatch();
    std::chrono::milliseconds lookInterval() const;
    void killIfStalled();
    bool killIfStopped();

    std::chrono::duration<double> progressTimeout_;
    std::string outputPath_;
    Progress lastProgress_;
    std::chrono::steady_clock::time_point lastLook_;
    std::chrono::duration<double> silence_{};  ///< time without progress, s
    bool hasStalled_ = false;
    std::function<bool()> mustStop_;
    bool isStopped_ = false;

    int input_ = -1;
    int log_ = -1;
    pid_t pid_ = -1;
};

/// Kills the programs of all objects of this class, for a program that ends without destroying them. May be called from
/// any thread and from a signal handler.
void killChildProcesses();

}  // namespace render
