// The C library's streams, whose errors stick.
#include "tools/standard_streams.h"

#include <cstdio>

#include "render/system_error.h"

namespace tools {

void say(const std::string& text) {
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

void requirePrinted() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
        throw render::SystemError("cannot write to standard output");
}

}  // namespace tools
