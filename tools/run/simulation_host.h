// Who computes the simulation of a run: this process, as here, or ranks that share its particles (mpi/rank_host.h). The
// sequence of frames asks its host, and sees the whole simulation at each frame.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/error_control/error_samples.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "scenes/model/scene.h"
#include "scenes/view/frame_view.h"
#include "tools/run/options.h"
#include "tools/system/interrupts.h"

namespace tools {

/// Computes the simulation of one run. A host that is not this process itself changes of the whole simulation what
/// can be seen from outside: particles, time and statistics.
class SimulationHost {
 public:
    SimulationHost() = default;
    SimulationHost(const SimulationHost&) = delete;
    SimulationHost& operator=(const SimulationHost&) = delete;
    virtual ~SimulationHost() = default;

    /// Tells the host which scene the run is of, before anything else.
    /// @throws scenes::InputError if it cannot simulate this scene
    virtual void load(const SceneOptions& /*options*/, const scenes::Scene& /*scene*/) {}

    /// The simulation of a scene at time zero.
    virtual engine::Simulation start(const scenes::Scene& scene) { return engine::start(scene.setup); }

    /// Goes on from a simulation that was read from a checkpoint.
    virtual void resume(const scenes::Scene& /*scene*/, engine::Simulation& /*whole*/) {}

    /// @throws as engine::advance()
    virtual void advanceToFrame(const scenes::Scene& scene, engine::Simulation& whole, int frame) {
        scenes::advanceToFrame(scene, whole, frame);
    }

    virtual void addSample(engine::ErrorSamples& samples, const engine::Simulation& whole, double frameSeconds,
                           double evaluationsOfFrame) {
        engine::addSample(samples, whole, frameSeconds, evaluationsOfFrame);
    }

    /// How long a frame may go on after a signal, s.
    virtual double graceSeconds() const { return InterruptOptions{}.graceSeconds; }

    /// The energy of the whole simulation at a frame.
    virtual engine::Energy energy(engine::Simulation& whole) { return engine::energy(whole); }

    virtual std::vector<std::uint8_t> checkpoint(const engine::Simulation& whole) {
        return engine::encodeCheckpoint(whole);
    }
};

}  // namespace tools
