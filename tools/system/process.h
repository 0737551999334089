// The process as the operating system and the shell see it: standard streams and exit codes. Used by main() and by
// every command that prints results. interrupts.h has the signals.
#pragma once

#include <csignal>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include "tools/system/json.h"

namespace tools {

/// The exit code of the program if the scene or the command line is wrong.
inline constexpr int kInputErrorCode = 2;

/// The exit code if the outside world has failed: OpenGL, ffmpeg, the disk.
inline constexpr int kOutsideFailedCode = 1;

/// The exit code if the simulation became unstable.
inline constexpr int kUnstableCode = 3;

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

}  // namespace tools
