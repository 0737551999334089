// Where the frames of a run come from: a simulation (frame_sequence.h), or the states that an earlier one has left
// (state_sequence.h). Here is what both have in common: files, signals and the report.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/run/frame_folder.h"
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
    bool isKept = false;    ///< the frame's files exist already; the simulation may be at another frame
    std::string stateHash;  ///< hash of the particles; empty if the frame gets no file
    std::optional<Checkpoint> checkpoint;  ///< of this frame; nothing if none is due
};

class FrameSource {
 public:
    FrameSource(const FrameSource&) = delete;
    FrameSource& operator=(const FrameSource&) = delete;
    virtual ~FrameSource() = default;

    /// Advances to the next frame. The simulation is at that frame unless the frame is kept. Returns nothing after the
    /// last frame, after a signal, and when there can be no more frames; report() tells which.
    virtual std::optional<SequencedFrame> next() = 0;

    /// Makes mustStop() true, because the run has failed elsewhere. May be called by any stage of the pipeline.
    void abort() { isAborted_ = true; }

    /// Whether the run is to end at once, after abort() or because a signal asks for that (interrupts.h): without the
    /// frames in flight, their video and a last checkpoint. May be called by any stage of the pipeline; once true, it
    /// stays true.
    bool mustStop() const { return isAborted_ || (interrupts_ && interrupts_->mustStop()); }

    /// Writes the file of a frame that next() returned, unless it is kept or not wanted, and then its checkpoint.
    void store(const SequencedFrame& frame, std::span<const std::uint8_t> bytes);

    /// Writes the checkpoint of a frame that next() returned, if one is due.
    /// @pre the files of the frame are written
    void storeCheckpoint(const SequencedFrame& frame);

    /// Completes the report, when all frames are stored.
    virtual void finish() = 0;

    /// Records in the report, after finish(), that a signal has stopped what was left to do: the end of the video.
    void recordInterrupt();

    /// Writes run.json, if there is a folder, and hands over the results.
    /// @pre finish() has been called
    virtual FinishedRun take() = 0;

    /// The particles and the time of the frame that next() has returned, unless that frame is kept.
    const engine::Simulation& simulation() const { return run_.simulation; }
    RunReport& report() { return run_.report; }

 protected:
    /// @param folder  writes the frames; nullptr if they are only passed on
    /// @param progress  must outlive the object
    /// @param graceSeconds  how long a frame may go on after a signal, s
    FrameSource(FrameFolder* folder, Progress& progress, double graceSeconds = InterruptOptions{}.graceSeconds);

    /// Whether the run must stop; the report then says so.
    bool recordStop();

    FrameFolder* folder_;
    Progress& progress_;
    FinishedRun run_;
    std::optional<InterruptWatch> interrupts_;  ///< watches for signals if the run can be resumed

 private:
    std::atomic<bool> isAborted_ = false;
};

}  // namespace tools
