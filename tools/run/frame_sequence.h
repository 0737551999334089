// The simulation's side of a run over frames: where it starts or resumes, the next frame, error samples, checkpoints,
// and the ways to end early. Used by the loops of `render` and `simulate`.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "tools/frames/frame_list.h"
#include "tools/run/frame_folder.h"
#include "tools/run/options.h"
#include "tools/run/run_report.h"
#include "tools/system/interrupts.h"
#include "tools/system/json.h"
#include "tools/system/progress.h"

namespace tools {

/// One frame of a run.
struct SequencedFrame {
    int number = 0;
    double time = 0.0;      ///< seconds
    bool isWanted = true;   ///< whether the frame was asked for; if not, it is simulated, but not written
    bool isKept = false;    ///< the frame's file exists already; the simulation may be at another frame
    std::string stateHash;  ///< hash of the particles; empty if the frame gets no file
    std::vector<std::uint8_t> checkpoint;  ///< encoded checkpoint of this frame; empty if none is due
    Json report;                           ///< what the run has measured so far, for the checkpoint
};

/// What a run over frames does besides simulating them.
struct SequenceOptions {
    FrameFolder* folder = nullptr;  ///< writes the frames; nullptr if they are only passed on
    bool estimatesErrors = true;    ///< whether the error of a fixed step is estimated at some of the frames
};

/// Simulates the frames of a run one after the other.
class FrameSequence {
 public:
    /// @param progress  is told of frames that are not wanted and of steps; must outlive the sequence
    FrameSequence(const scenes::Scene& scene, FrameList frames, const SequenceOptions& options, Progress& progress);
    FrameSequence(const FrameSequence&) = delete;
    FrameSequence& operator=(const FrameSequence&) = delete;

    /// Advances to the next frame. The simulation is at that frame unless the frame is kept. Returns nothing after the
    /// last frame, after a signal, and when the simulation has become unstable; report() tells which.
    std::optional<SequencedFrame> next();

    /// Makes mustStop() true, because the run has failed elsewhere. May be called by any stage of the pipeline.
    void abort() { isAborted_ = true; }

    /// Whether the run is to end at once, after abort() or because a signal asks for that (interrupts.h): without the
    /// frames in flight, their video and a last checkpoint. May be called by any stage of the pipeline; once true, it
    /// stays true.
    bool mustStop() const { return isAborted_ || (interrupts_ && interrupts_->mustStop()); }

    /// Writes the file of a frame that next() returned, unless it is kept or not wanted, and then its checkpoint.
    void store(const SequencedFrame& frame, std::span<const std::uint8_t> bytes);

    /// Writes the last checkpoint, unless the run must stop, and completes the report, when all frames are stored.
    void finish();

    /// Records in the report, after finish(), that a signal has stopped what was left to do: the end of the video.
    void recordInterrupt();

    /// Writes run.json, if there is a folder, and hands over the results.
    /// @pre finish() has been called
    FinishedRun take();

    const engine::Simulation& simulation() const { return run_.simulation; }
    RunReport& report() { return run_.report; }

 private:
    bool resume();
    bool advanceTo(int frame);
    Json checkpointReport() const;

    const scenes::Scene& scene_;
    FrameList frames_;
    FrameFolder* folder_;
    bool estimatesErrors_;
    Progress& progress_;
    FinishedRun run_;
    std::optional<InterruptWatch> interrupts_;  ///< watches for signals if the run can be resumed
    std::atomic<bool> isAborted_ = false;
    int position_ = -1;  ///< the frame that the simulation is at; -1 before the first
    int next_ = 0;
    std::chrono::steady_clock::time_point lastCheckpoint_;
};

}  // namespace tools
