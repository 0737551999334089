// Moves heat along the links of a network for a time, each link in both directions, so that the sum of all heat changes
// by what obstacles and air give alone.
#pragma once

#include <functional>
#include <vector>

#include "engine/forces/conjugate_gradient.h"
#include "engine/heat/heat_network.h"

namespace engine {

/// Brings a number of each own particle and those of the ghosts into combined order. A run in one process has no
/// ghosts.
using ShareNumbers = std::function<void(const std::vector<double>& own, std::vector<double>& combined)>;

/// Vectors of an exchange.
struct HeatScratch {
    std::vector<double> temperature;  ///< of the own particles, K
    std::vector<double> combined;     ///< in combined order
    std::vector<double> before;       ///< enthalpies at the start, J
    std::vector<double> capacity;     ///< of particles whose temperature can change, J/K; 0 for others
    std::vector<double> diagonal;     ///< of the implicit exchange's matrix, J/K
    std::vector<double> missing;      ///< heat that the temperatures do not account for, J
    std::vector<double> change;       ///< of temperatures, K
    GradientScratch<double> gradients;
};

/// Temperature of a particle, K.
double temperatureOf(const std::vector<Material>& materials, const Particles& particles, std::size_t p);

/// Share of the largest stable step of an explicit exchange up to which one is taken. Chosen: at the largest, the
/// temperatures of two particles would change places.
inline constexpr double kExplicitShare = 0.5;

/// Whether an exchange for some seconds is explicit, so that it needs no links.
bool isExplicit(const HeatNetwork& network, const std::vector<Material>& materials, const Ranks& ranks, double seconds,
                const Particles& particles);

/// Exchanges heat for some seconds, and changes the particles' enthalpies; returns what obstacles and air have given,
/// J. Explicit where that is stable, which needs a network's links or that the particles have the temperatures that it
/// was found at; otherwise by the backward Euler method. No temperature leaves the range between the lowest and the
/// highest of particles, obstacles and air, up to the solver's tolerance, 1e-6 K.
double exchangeHeat(const HeatNetwork& network, const std::vector<Material>& materials, const Ranks& ranks,
                    const ShareNumbers& share, double seconds, Particles& particles, HeatScratch& scratch);

}  // namespace engine
