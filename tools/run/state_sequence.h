// The states of an earlier simulation, one after the other: the frames of `render --states` and `mesh
// --states`.
#pragma once

#include <cstddef>
#include <exception>
#include <optional>
#include <string>

#include "scenes/model/scene.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/simulated_states.h"
#include "tools/run/frame_source.h"

namespace tools {

/// The states of a scene that `--states` names; nothing if it names none. Those of another version of the program are
/// warned of on standard error.
/// @throws as the constructor of SimulatedStates
std::optional<SimulatedStates> openStates(const std::string& folder, const scenes::Scene& scene,
                                          const FrameList& frames);

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
