// Standard streams are written with the C library, whose error flags stay set until they are read.
#include "tools/system/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/system/text.h"

namespace tools {
namespace {

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

}  // namespace tools
