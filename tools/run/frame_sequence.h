// The simulation's side of a run over frames: where it starts or goes on, the next frame, what is measured on the way,
// checkpoints, and the ways to end early. Used by the loops of `render` and `simulate`.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "tools/run/frame_folder.h"
#include "tools/run/run_report.h"
#include "tools/run/scene_options.h"
#include "tools/system/interrupt.h"
#include "tools/system/json.h"

namespace tools {

/// One frame of a run, in order.
struct SequencedFrame {
    int number = 0;
    double time = 0.0;                     ///< s
    bool isWanted = true;                  ///< false on the way to the first that was asked for
    bool isKept = false;                   ///< its file is there; the simulation may stand elsewhere
    std::string stateHash;                 ///< of a frame that is wanted and not kept, where there is a folder
    std::vector<std::uint8_t> checkpoint;  ///< of the simulation at this frame; mostly empty
    Json report;                           ///< goes with the checkpoint
};

class FrameSequence {
 public:
    /// folder: where the frames go, nullptr for a run that cannot be gone on with. checkpointSeconds: between two
    /// checkpoints.
    FrameSequence(const scenes::Scene& scene, FrameRange frames, FrameFolder* folder, double checkpointSeconds);

    /// Goes to the next frame; the simulation stands there unless it is kept. Nothing after the last one, after a
    /// signal, and where the simulation became unstable, which the report then says.
    std::optional<SequencedFrame> next();

    /// Puts the files of a frame that next() gave in their places: first the frame's own, where it has one.
    void store(const SequencedFrame& frame, std::span<const std::uint8_t> bytes);

    /// When all frames are stored: the last checkpoint, and the fields of the report that are known by now.
    void finish();

    const engine::Simulation& simulation() const { return run_.simulation; }
    RunReport& report() { return run_.report; }
    FinishedRun take() { return std::move(run_); }

 private:
    bool goOn();
    bool advanceTo(int frame);
    bool isCheckpointDue() const;
    Json checkpointReport() const;

    const scenes::Scene& scene_;
    FrameRange frames_;
    FrameFolder* folder_;
    double checkpointSeconds_;
    FinishedRun run_;
    std::optional<InterruptWatch> interrupts_;  ///< where the run can be gone on with
    int position_ = -1;                         ///< the frame that the simulation stands at; -1 before the first
    int next_ = 0;
    std::chrono::steady_clock::time_point lastCheckpoint_;
};

}  // namespace tools
