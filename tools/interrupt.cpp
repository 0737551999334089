// A handler may do no more than note the signal.
#include "tools/interrupt.h"

#include <array>
#include <csignal>

namespace tools {
namespace {

volatile std::sig_atomic_t noted = 0;

constexpr std::array kSignals = {SIGINT, SIGTERM};

void note(int signal) {
    noted = signal;
}

}  // namespace

InterruptWatch::InterruptWatch() {
    noted = 0;
    struct sigaction action = {};
    action.sa_handler = note;
    // Back to the default after the first: a user who insists is obeyed.
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : kSignals) ::sigaction(signal, &action, nullptr);
}

InterruptWatch::~InterruptWatch() {
    for (const int signal : kSignals) ::signal(signal, SIG_DFL);
}

int InterruptWatch::signal() const {
    return noted;
}

}  // namespace tools
