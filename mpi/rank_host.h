// A run that several ranks compute. Rank 0 runs the command as a process alone would: it reads the scene, and writes
// the frames, which it collects from all ranks. What the others are to do it tells them by short orders.
#pragma once

#include <optional>
#include <vector>

#include "mpi/mpi_ranks.h"
#include "tools/run/simulation_host.h"
#include "tools/system/json.h"

namespace mpi {

/// How a run is divided.
struct DivisionOptions {
    bool isBalanced = true;  ///< whether the division follows the particles, or stays as it is at first
};

/// The host of the run on rank 0.
class RankHost : public tools::SimulationHost {
 public:
    RankHost(MpiRanks& ranks, DivisionOptions options) : ranks_(ranks), options_(options) {}
    /// Dismisses the other ranks.
    ~RankHost() override;

    DivisionOptions& options() { return options_; }

    void load(const tools::SceneOptions& options, const scenes::Scene& scene) override;
    engine::Simulation start(const scenes::Scene& scene) override;
    void resume(const scenes::Scene& scene, engine::Simulation& whole) override;
    void advanceToFrame(const scenes::Scene& scene, engine::Simulation& whole, int frame) override;
    void addSample(engine::ErrorSamples& samples, const engine::Simulation& whole, double frameSeconds,
                   double evaluationsOfFrame) override;
    engine::Energy energy(engine::Simulation& whole) override;
    /// mpirun kills its processes a second after it has sent them a signal; half of that is left to write what there
    /// is.
    double graceSeconds() const override { return 0.4; }
    std::vector<std::uint8_t> checkpoint(const engine::Simulation& whole) override;

 private:
    void order(const tools::Json& json) const { ranks_.broadcast(json.dump()); }

    MpiRanks& ranks_;
    DivisionOptions options_;
    engine::Simulation simulation_;  ///< of the particles of this rank
};

/// Does what rank 0 orders, on another rank, until it dismisses this one.
void serve(MpiRanks& ranks);

}  // namespace mpi
