// The process as the operating system and the shell see it: standard streams, exit codes and signals. Used by main()
// and by every command that prints results or can be interrupted.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "tools/system/json.h"

namespace tools {

/// The exit code of the program if the scene or the command line is wrong.
inline constexpr int kInputErrorCode = 2;

/// A shell reports a program that a signal ended with this code plus the number of the signal.
inline constexpr int kSignalExitBase = 128;

/// The exit code that a shell reports for a program that wrote to a pipe without a reader.
inline constexpr int kReaderGoneCode = kSignalExitBase + SIGPIPE;

/// Thrown by a command to end the program with a given exit code. main() prints the message as an error unless it is
/// empty.
class ExitStatus : public std::runtime_error {
 public:
    ExitStatus(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
    int code() const { return code_; }

 private:
    int code_;
};

/// Opens /dev/null for each of the three standard streams that is closed, so that no file opened later takes its
/// descriptor. SIGPIPE and SIGXFSZ are ignored from then on, so that a reader that goes away and a limit on the size of
/// files (`ulimit -f`) are errors of the write and do not end a run halfway.
void prepareStandardStreams();

/// Warns if TMPDIR, or another variable that names the folder for temporary files, does not name a folder, and sets
/// TMPDIR to the system's folder, for this program and those that it starts.
void ensureTemporaryFolder();

/// Prints printable() text to standard output.
/// @throws std::system_error
void printText(const std::string& text);

/// Prints JSON on a line of its own to standard output, as --json promises, and flushes it, so that a program that
/// reads along gets each line at once.
/// @throws as flushStandardOutput() does
void printJson(const Json& json);

/// Prints printable() text to standard error and ignores failures, because a lost message must not end a run.
void printToStderr(const std::string& text);

/// As printToStderr(), in place of the present line of the terminal.
void printOverLine(const std::string& text);

/// Writes "warning: ..." to standard error.
void printWarning(const std::string& message);

/// Everything on standard input, as text.
/// @param limit  in bytes
/// @throws scenes::InputError if there is more than the limit, or reading fails
std::string readStandardInput(std::size_t limit);

/// Writes bytes to standard output and flushes it.
/// @throws as flushStandardOutput() does
void writeStandardOutput(std::span<const std::uint8_t> bytes);

/// Flushes standard output.
/// @throws render::SystemError if anything printed so far could not be written
/// @throws ExitStatus with kReaderGoneCode and no message if the reader of the pipe is gone
void flushStandardOutput();

/// While an object of this class exists, the first SIGINT, SIGTERM or SIGHUP is recorded instead of ending the program,
/// so that a run can finish its frame and save what it needs to resume. What the program was started to ignore stays
/// ignored.
class InterruptWatch {
 public:
    /// @param recordedCount  how many signals are recorded; the next one ends the program at once. Two for work that
    /// asks mustStop()
    /// @param notice  what the signal handler writes to standard error when the first signal is a SIGINT; must outlive
    /// the object; nullptr: nothing
    explicit InterruptWatch(int recordedCount = 1, const char* notice = nullptr);
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// The number of the first signal that arrived, or 0.
    int signal() const;

    /// Whether even the work of the present frame must end: after a second signal, and a few seconds after a SIGTERM or
    /// SIGHUP, whose sender waits a limited time. May be called from any thread.
    bool mustStop() const;

 private:
    std::array<struct sigaction, 3> previousActions_ = {};
};

}  // namespace tools
