// No checkpoints are needed: the states are all there. A state that cannot be read ends the run after the frames before
// it.
#include "tools/run/state_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tools/system/memory.h"
#include "tools/system/process.h"

namespace tools {

std::optional<SimulatedStates> openStates(const std::string& folder, const scenes::Scene& scene,
                                          const FrameList& frames) {
    if (folder.empty()) return std::nullopt;
    std::optional<SimulatedStates> states(std::in_place, folder, scene, sceneIdentity(scene), frames);
    if (states->version() != GLOBULAR_VERSION)
        printWarning(fmt::format("the states in {} are of version {}; this version, {}, may simulate others", folder,
                                 states->version(), GLOBULAR_VERSION));
    return states;
}

StateSequence::StateSequence(const scenes::Scene& scene, FrameList frames, const SimulatedStates& states,
                             FrameFolder* folder, Progress& progress)
    : FrameSource(folder, progress), scene_(scene), frames_(std::move(frames)), states_(states) {}

std::optional<SequencedFrame> StateSequence::next() {
    if (failure_ || next_ == frames_.numbers.size()) return std::nullopt;
    if (interrupts_) run_.report.interruptedBy = interrupts_->signal();
    if (run_.report.interruptedBy != 0 || mustStop()) return std::nullopt;
    SequencedFrame frame;
    frame.number = frames_.numbers[next_++];
    frame.time = scenes::frameTime(scene_, frame.number);
    frame.isKept = folder_ != nullptr && folder_->isKept(frame.number);
    frame.stateHash = run_.report.stateHash = states_.stateHash(frame.number);
    try {
        if (!frame.isKept) read(frame);
    } catch (...) {
        // Thrown by finish(), because earlier frames are still being drawn.
        failure_ = std::current_exception();
        return std::nullopt;
    }
    return frame;
}

/// Puts the state of a frame into the simulation.
void StateSequence::read(const SequencedFrame& frame) {
    const Stopwatch watch(run_.report.seconds.reading);
    const Progress::Work work(progress_, fmt::format("reading the state of frame {}", frame.number));
    run_.simulation.particles =
        withMemoryFor([&] { return fmt::format("reading {}", states_.pathOf(frame.number).string()); },
                      "draw on a machine with more memory", [&] { return states_.read(frame.number); });
    run_.simulation.time = frame.time;
    run_.report.largestCount = std::max(run_.report.largestCount, run_.simulation.particles.count());
}

void StateSequence::finish() {
    if (failure_) std::rethrow_exception(failure_);
    recordStop();
}

FinishedRun StateSequence::take() {
    run_.json = drawnRunJson(scene_, run_.report, states_);
    if (folder_ != nullptr) folder_->writeReport(run_.json);
    return std::move(run_);
}

}  // namespace tools
