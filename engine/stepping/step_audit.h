// The audit: no step may gain energy, and no step may carry a particle past what it is about to meet. A step that does
// is rejected: the state before it is restored. Called after every step but the paper's.
#pragma once

#include <optional>

#include "engine/neighbors/linked_cells.h"
#include "engine/state/simulation.h"

namespace engine {

/// Share of the kinetic energy that a step may gain. Chosen: rounding and truncation of a good step stay below it.
inline constexpr double kEnergyAllowance = 1e-3;

/// Energy that a step from this state may gain, J: the share above of the kinetic energy, increased by that of a slow
/// motion of a tenth of a radius per second, so that a scene can come to rest.
double energyAllowance(const Simulation& simulation);

/// Energy of one particle without the pairs', or the sum of it over particles, J.
struct ParticleEnergy {
    double kinetic = 0.0;
    double potential = 0.0;  ///< in gravity and at the obstacles

    ParticleEnergy& operator+=(const ParticleEnergy& other) {
        kinetic += other.kinetic;
        potential += other.potential;
        return *this;
    }
};

/// Energy of one particle in its present state.
/// @param contacts  its energy at the obstacles, J
inline ParticleEnergy particleEnergy(const Simulation& simulation, std::size_t p, double contacts) {
    const Particles& particles = simulation.particles;
    const double mass = particles.mass[p];
    return {0.5 * mass * squaredLength(particles.velocity[p]),
            contacts - mass * dot(simulation.setup.gravity, particles.position[p])};
}

/// Records the energy and the kinetic energy of the present state, J, where the stepper knows both sums.
void recordEnergy(Simulation& simulation, const ParticleEnergy& own, double pairEnergy);

/// Records the energy of the present state where only the pairs' energy (J) is known; the particles' is summed here.
void recordEnergy(Simulation& simulation, double pairEnergy);

/// Records that no forces can be computed from the present state; the step will be rejected.
void markInvalid(Simulation& simulation);

/// Adds the energy of the particles from index `first` on, which have just been emitted, to the recorded energy. The
/// cells hold all particles and are at least as wide as the pairs' cutoff.
void addEnergyOfEmitted(Simulation& simulation, std::size_t first, const LinkedCells& cells);

/// A state that can be restored, and what the step from it is judged by.
struct SavedState {
    double time = 0.0;  ///< s
    std::vector<Vec3> position;
    std::vector<Vec3> velocity;
    std::vector<Vec3> forces;
    std::vector<EmitterState> emitters;
    bool forcesCurrent = false;
    std::optional<double> energy;
    double kinetic = 0.0;
    double allowance = 0.0;  ///< J
    StepStatistics steps;
};

/// Saves the state; the memory of `saved` is used again.
void save(const Simulation& simulation, SavedState& saved);

/// Restores a saved state. Particles emitted since then are removed, and the steps since then are no longer counted,
/// but their cost is.
void restore(Simulation& simulation, const SavedState& saved);

/// Why the step since `saved` must be rejected; nothing if it is accepted.
std::optional<StepLimit> rejectionReason(const Simulation& simulation, const SavedState& saved);

}  // namespace engine
