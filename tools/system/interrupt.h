// SIGINT and SIGTERM as a wish: the run finishes the frame in hand, keeps what is needed to go on, and then ends. A
// second signal ends it at once.
#pragma once

#include <array>
#include <csignal>

namespace tools {

/// While one lives, the first SIGINT or SIGTERM is noted instead of ending the program.
class InterruptWatch {
 public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// The signal that came, or 0.
    int signal() const;

 private:
    std::array<struct sigaction, 2> before_ = {};
};

}  // namespace tools
