// SIGINT and SIGTERM as a wish: the run finishes the frame in hand, keeps what is needed to go on, and then ends. A
// second signal ends it at once.
#pragma once

#include <stdexcept>
#include <string>

namespace tools {

/// A run that a signal ended early, with everything in place to go on; what() says how.
class Interrupted : public std::runtime_error {
 public:
    Interrupted(int signal, const std::string& message) : std::runtime_error(message), signal_(signal) {}

    int signal() const { return signal_; }

 private:
    int signal_ = 0;
};

/// While one lives, the first SIGINT or SIGTERM is noted instead of ending the program.
class InterruptWatch {
 public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// The signal that came, or 0.
    int signal() const;
};

}  // namespace tools
