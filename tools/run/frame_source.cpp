// A run that has a folder can be resumed, and is therefore ended in order by a signal.
#include "tools/run/frame_source.h"

#include <unistd.h>

namespace tools {
namespace {

/// What the first Ctrl-C is answered with. On a terminal it replaces the line of progress, which is drawn again below.
constexpr const char* kNotice = "ending within two seconds; press again to stop now\n";
constexpr const char* kNoticeOnTerminal = "\r\x1b[Kending within two seconds; press again to stop now\n";

/// What is said where the run ends where it stands.
constexpr const char* kLastWords =
    "error: interrupted; the frames that are whole are kept; to go on, give the same command with --resume (and "
    "without "
    "--overwrite)\n";

}  // namespace

FrameSource::FrameSource(FrameFolder* folder, Progress& progress, double graceSeconds)
    : folder_(folder), progress_(progress) {
    const char* const notice = progress_.verbosity() == Verbosity::quiet ? nullptr
                               : isatty(STDERR_FILENO) == 1              ? kNoticeOnTerminal
                                                                         : kNotice;
    if (folder_ != nullptr) interrupts_.emplace(InterruptOptions{true, graceSeconds, notice, kLastWords});
}

void FrameSource::store(const SequencedFrame& frame, std::span<const std::uint8_t> bytes) {
    if (frame.isWanted && !frame.isKept) folder_->write(frame.number, bytes, frame.stateHash);
    storeCheckpoint(frame);
}

void FrameSource::storeCheckpoint(const SequencedFrame& frame) {
    if (frame.checkpoint) folder_->writeCheckpoint(frame.number, *frame.checkpoint);
}

bool FrameSource::recordStop() {
    // This is the only place that decides whether the run was complete, because the signal may come at any moment.
    if (!mustStop()) return false;
    run_.report.interruptedBy = interrupts_ ? interrupts_->signal() : 0;
    run_.report.isCutShort = true;
    run_.report.stateHash.clear();
    return true;
}

void FrameSource::recordInterrupt() {
    if (interrupts_) run_.report.interruptedBy = interrupts_->signal();
}

}  // namespace tools
