// The audit of time steps, a check of every step that was taken. A step is rejected if it gains energy, beyond the work
// that obstacles in motion do, or moves a
// particle by more than its radius, in free fall relative to its group (free_groups.h); then the state before it is
// restored. Every step is audited, except those of the paper's stepper.
#pragma once

#include <optional>

#include "engine/neighbors/linked_cells.h"
#include "engine/state/simulation.h"
#include "engine/stepping/step_cache.h"

namespace engine {

/// Share of the kinetic energy that a step may gain. Chosen: rounding and truncation errors of a good step are smaller.
inline constexpr double kEnergyAllowance = 1e-3;

/// Energy that a step from this state may gain, J: the share kEnergyAllowance of the kinetic energy. To the kinetic
/// energy that of a slow motion, a tenth of a radius per second, is added, so that a scene can come to rest. The audit
/// takes off the share of groups that are in free fall far from all others, whose fall would hide any gain elsewhere.
double energyAllowance(const Simulation& simulation);

/// Energy of one particle, or of many, without the energy of pairs, J.
struct ParticleEnergy {
    double kinetic = 0.0;
    double potential = 0.0;  ///< energy in gravity and at the obstacles
};

/// Energy of one particle in its present state, without the energy of pairs.
/// @param contacts  energy of the particle at the obstacles, J
inline ParticleEnergy particleEnergy(const Simulation& simulation, std::size_t p, double contacts) {
    const Particles& particles = simulation.particles;
    const double mass = particles.mass[p];
    return {0.5 * mass * squaredLength(particles.velocity[p]),
            contacts - mass * dot(simulation.setup.gravity, particles.position[p])};
}

/// Records the energy of the present state, with which the audit compares that after the next step, from the sums over
/// particles and over pairs (J).
void recordEnergy(Simulation& simulation, const ParticleEnergy& own, double pairEnergy);

/// Records the energy of the present state for the audit; the sum over particles is computed here, the pair energy (J)
/// is given.
/// @param time  at which the obstacles are where they are, s
void recordEnergy(Simulation& simulation, double pairEnergy, double time);

/// Records a NaN as the energy, so that the audit will reject the step. For states from which no forces can be
/// computed.
void markInvalid(Simulation& simulation);

/// Adds the energy of newly emitted particles to the recorded energy.
/// @param emitted  the new particles of all ranks
/// @param cells    contain all particles of this rank; at least as wide as the cutoff of the pair forces
void addEnergyOfEmitted(Simulation& simulation, const Particles& emitted, const LinkedCells& cells);

/// The state before a step, which can be restored, and the energies by which the step is judged.
struct SavedState {
    double time = 0.0;  ///< s
    std::vector<Vec3> position;
    std::vector<Vec3> velocity;
    std::uint32_t nextId = 0;
    std::vector<Vec3> forces;
    std::vector<EmitterState> emitters;
    bool forcesCurrent = false;
    std::optional<double> energy;
    double kinetic = 0.0;
    std::vector<GroupEnergy> groupEnergies;
    double work = 0.0;          ///< as in the step cache, J
    double workAtEnergy = 0.0;  ///< as in the step cache, J
    double allowance = 0.0;     ///< energy that the next step may gain, J
    StepStatistics steps;
};

/// Saves the present state in `saved`, whose memory is used again.
void save(const Simulation& simulation, SavedState& saved);

/// Restores a saved state. Particles that were emitted after it was saved are removed. Steps taken after it are no
/// longer counted, but the force evaluations that they have cost are.
void restore(Simulation& simulation, const SavedState& saved);

/// The reason to reject the step that led from the saved state to the present one; empty if the step is accepted.
std::optional<StepLimit> rejectionReason(const Simulation& simulation, const SavedState& saved);

}  // namespace engine
