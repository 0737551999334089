// Signals that ask the program to end. Used by the commands that have something to finish or to keep before they do.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <functional>
#include <memory>

namespace tools {

/// What signals may do while an InterruptWatch exists.
struct InterruptOptions {
    /// Whether the program ends soon whatever it does: mustStop() becomes true graceSeconds after the first signal,
    /// or with the second one. Two seconds after the first signal, or a tenth of a second after the second, the program
    /// ends where it stands. Without this the second signal ends it at once.
    bool endsSoon = false;
    /// How long the present frame may take after the first signal until mustStop(), s. Chosen: a second is left to
    /// write what there is and to stop ffmpeg.
    double graceSeconds = 1.2;
    /// What the signal handler writes to standard error when the first signal is a SIGINT; must outlive the object;
    /// nullptr: nothing.
    const char* notice = nullptr;
    /// What is written to standard error when the program ends where it stands; must outlive the object.
    const char* lastWords = "";
};

/// While an object of this class exists, the first SIGINT, SIGTERM or SIGHUP is recorded instead of ending the program,
/// so that a run can finish its frame and save what it needs to resume. What the program was started to ignore stays
/// ignored. There may be one at a time.
class InterruptWatch {
 public:
    explicit InterruptWatch(const InterruptOptions& options = {});
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// The number of the first signal that arrived, or 0.
    int signal() const;

    /// Whether even the work of the present frame must end. Stays true. May be called from any thread.
    bool mustStop() const;

 private:
    class Deadline;

    bool endsSoon_;
    std::int64_t graceTime_;  ///< ns
    std::array<struct sigaction, 3> previousActions_ = {};
    std::unique_ptr<Deadline> deadline_;  ///< ends the program in time; nullptr unless it ends soon
};

}  // namespace tools
