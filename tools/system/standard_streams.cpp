// The C library's streams, whose errors stick.
#include "tools/system/standard_streams.h"

#include <fcntl.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "render/picture/system_error.h"
#include "tools/system/exit_status.h"

namespace tools {

void prepareStandardStreams() {
    for (const int descriptor : {0, 1, 2})
        if (::fcntl(descriptor, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);  // gets the lowest number that is free
    std::signal(SIGPIPE, SIG_IGN);
}

void printToStderr(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

void flushStandardOutput() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    if (errno == EPIPE) throw ExitStatus(kReaderGoneCode, "");
    throw render::SystemError("cannot write to standard output");
}

}  // namespace tools
