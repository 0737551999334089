// Measurements of a state: energy, linear and angular momentum, largest speed, and a hash that is equal for two runs if
// every bit of their particles agrees. Energies are exact sums, rounded once, and other sums run in the order of the
// particles, so that none depends on the numbers of threads and ranks.
#pragma once

#include <string>

#include "engine/forces/forces.h"
#include "engine/state/simulation.h"

namespace engine {

struct Energy {
    double kinetic = 0.0;   ///< J
    double pairs = 0.0;     ///< sum of the pair energies U(D), J
    double contacts = 0.0;  ///< energy at obstacles, J
    double gravity = 0.0;   ///< potential energy, the sum of -m g.x, J
    double fields = 0.0;    ///< potential energy in the conservative fields, J

    double total() const { return kinetic + pairs + contacts + gravity + fields; }
};

/// Energy of a set of particles under the force law of an evaluator.
/// @param time  at which the obstacles are where they are, s
Energy energy(ForceEvaluator& evaluator, const Particles& particles, double time = 0.0,
              const Ranks& ranks = Ranks::alone());

/// Energy of the present state of a simulation.
Energy energy(Simulation& simulation);

Vec3 linearMomentum(const Particles& particles);   ///< kg m/s
Vec3 angularMomentum(const Particles& particles);  ///< angular momentum about the origin, kg m^2/s
double largestSpeed(const Particles& particles);   ///< largest speed of a particle, m/s; 0 without particles

/// 64-bit FNV-1a over id, position and velocity of every particle in order, and the enthalpies of a run with heat, as 16
/// hexadecimal digits.
std::string stateHash(const Particles& particles);

}  // namespace engine
