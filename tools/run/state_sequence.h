// The states of an earlier simulation, one after the other: the frames of `render --states`.
#pragma once

#include <cstddef>
#include <exception>
#include <optional>

#include "scenes/model/scene.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/simulated_states.h"
#include "tools/run/frame_source.h"

namespace tools {

/// Reads the states of the frames of a run.
class StateSequence : public FrameSource {
 public:
    /// @param states, progress  must outlive the sequence
    StateSequence(const scenes::Scene& scene, FrameList frames, const SimulatedStates& states, FrameFolder* folder,
                  Progress& progress);

    /// Also returns nothing when a state cannot be read or is damaged.
    std::optional<SequencedFrame> next() override;
    /// @throws render::SystemError if a state could not be read or is damaged
    void finish() override;
    FinishedRun take() override;

 private:
    void read(const SequencedFrame& frame);

    const scenes::Scene& scene_;
    FrameList frames_;
    const SimulatedStates& states_;
    std::size_t next_ = 0;        ///< position in the list of frames
    std::exception_ptr failure_;  ///< why a state could not be read
};

}  // namespace tools
