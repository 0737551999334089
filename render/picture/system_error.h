// The exceptions that render/ and tools/ throw for failures outside the program: OpenGL, ffmpeg, the disk, a damaged
// PNG file.
#pragma once

#include <stdexcept>

namespace render {

/// A failure outside the program. The message says what was tried, on which file or program, and gives the reason in
/// that program's or the system's own words.
class SystemError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// OpenGL failed, or lacks something that the machine, the build or a picture of this size needs. The renderer on the
/// CPU may draw all the same.
class OpenGlError : public SystemError {
 public:
    using SystemError::SystemError;
};

}  // namespace render
