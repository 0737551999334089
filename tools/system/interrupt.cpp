// A handler may do no more than note the signal and step back.
#include "tools/system/interrupt.h"

#include <atomic>

namespace tools {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM};

std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler must not wait");

void note(int signal) {
    noted = signal;
    // A user who insists is obeyed.
    for (const int each : kSignals) ::signal(each, SIG_DFL);
}

}  // namespace

InterruptWatch::InterruptWatch() {
    noted = 0;
    struct sigaction action = {};
    action.sa_handler = note;
    action.sa_flags = SA_RESTART;
    for (std::size_t s = 0; s < kSignals.size(); ++s) ::sigaction(kSignals[s], &action, &before_[s]);
}

InterruptWatch::~InterruptWatch() {
    for (std::size_t s = 0; s < kSignals.size(); ++s) ::sigaction(kSignals[s], &before_[s], nullptr);
}

int InterruptWatch::signal() const {
    return noted;
}

}  // namespace tools
