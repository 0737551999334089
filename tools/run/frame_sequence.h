// The simulation's side of a run over frames: where it starts or resumes, the next frame, error samples, checkpoints,
// and the ways to end early. Used by the loops of `render` and `simulate`.
#pragma once

#include <chrono>
#include <optional>

#include "scenes/model/scene.h"
#include "tools/frames/frame_list.h"
#include "tools/loads/load_table.h"
#include "tools/run/frame_source.h"
#include "tools/run/simulation_host.h"

namespace tools {

/// What a run over frames does besides simulating them.
struct SequenceOptions {
    FrameFolder* folder = nullptr;   ///< writes the frames; nullptr if they are only passed on
    bool estimatesErrors = true;     ///< whether the error of a fixed step is estimated at some of the frames
    SimulationHost* host = nullptr;  ///< computes the simulation; nullptr: this process
};

/// Simulates the frames of a run one after the other.
class FrameSequence : public FrameSource {
 public:
    /// @param progress  is told of frames that are not wanted and of steps; must outlive the sequence
    FrameSequence(const scenes::Scene& scene, FrameList frames, const SequenceOptions& options, Progress& progress);

    /// Also returns nothing when the simulation has become unstable.
    std::optional<SequencedFrame> next() override;

    /// Writes the last checkpoint, unless the run must stop, and completes the report, when all frames are stored.
    void finish() override;

    FinishedRun take() override;

 private:
    bool resume();
    Checkpoint checkpoint();
    bool advanceTo(int frame);
    Json checkpointReport() const;

    const scenes::Scene& scene_;
    FrameList frames_;
    bool estimatesErrors_;
    SimulationHost own_;
    SimulationHost& host_;
    int position_ = -1;  ///< the frame that the simulation is at; -1 before the first
    LoadTable loads_;    ///< up to that frame
    int next_ = 0;
    std::chrono::steady_clock::time_point lastCheckpoint_;
};

}  // namespace tools
