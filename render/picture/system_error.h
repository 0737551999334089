// The exception of render/ and tools/ for failures outside the program: OpenGL, ffmpeg, the disk, a damaged PNG file.
#pragma once

#include <stdexcept>

namespace render {

/// The message says what was tried, on what, and gives the reason in the other side's own words.
class SystemError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

}  // namespace render
