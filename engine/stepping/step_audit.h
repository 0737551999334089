// The audit: no step may gain energy, and no step may carry a particle past what it is about to meet. A step that does
// is taken back. Called after every step but the paper's.
#pragma once

#include <optional>

#include "engine/neighbors/linked_cells.h"
#include "engine/state/simulation.h"

namespace engine {

/// A step may gain this share of the kinetic energy: rounding and truncation of a good step stay below it.
inline constexpr double kEnergyAllowance = 1e-3;

/// Energy that a step from this state may gain, J: the share above of the kinetic energy, and of that of a slow motion
/// of a tenth of a radius per second, so that a scene can come to rest.
double energyAllowance(const Simulation& simulation);

/// What the audit sums up over the particles, J.
struct OwnEnergy {
    double kinetic = 0.0;
    double potential = 0.0;  ///< of obstacles and gravity

    OwnEnergy& operator+=(const OwnEnergy& other) {
        kinetic += other.kinetic;
        potential += other.potential;
        return *this;
    }
};

/// Of one particle as it stands; contacts: its energy at the obstacles, J.
inline OwnEnergy ownEnergy(const Simulation& simulation, std::size_t p, double contacts) {
    const Particles& particles = simulation.particles;
    const double mass = particles.mass[p];
    return {0.5 * mass * squaredLength(particles.velocity[p]),
            contacts - mass * dot(simulation.setup.gravity, particles.position[p])};
}

/// Records energy and kinetic energy of the particles as they stand, J. Steppers call it where they know all of it.
void noteEnergy(Simulation& simulation, const OwnEnergy& own, double pairEnergy);

/// The same, where nothing but the pairs' energy (J) is known.
void noteEnergy(Simulation& simulation, double pairEnergy);

/// Records that the state is not one to compute forces from; the step will be taken back.
void markInvalid(Simulation& simulation);

/// Adds to the recorded energy what the particles from `first` on bring with them, J. The cells hold all particles and
/// are at least as wide as the pairs' cutoff.
void addEnergyOfEmitted(Simulation& simulation, std::size_t first, const LinkedCells& cells);

/// A state that a run can be taken back to, and what the step from it is judged by.
struct BeforeStep {
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

/// Keeps the state; `kept` is reused for its memory.
void keep(const Simulation& simulation, BeforeStep& kept);

/// Goes back to a state; particles born since then are gone, and so are the steps since then, but not their cost.
void takeBack(Simulation& simulation, const BeforeStep& kept);

/// Why the step since `kept` must be taken back; nothing if it may stay.
std::optional<StepLimit> objection(const Simulation& simulation, const BeforeStep& kept);

}  // namespace engine
