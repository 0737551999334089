// The one exception of render/ for failures outside the program: GL, ffmpeg, a broken PNG.
#pragma once

#include <stdexcept>

namespace render {

/// The outside world failed; the message says what was tried, on what, and gives the other side's own words.
class SystemError : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

}  // namespace render
