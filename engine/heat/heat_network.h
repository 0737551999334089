// The links that heat can take at a moment: conductances between neighboring particles, to obstacles and to the air.
// Found from where the particles are; heat_exchange.h then moves heat along them.
//
// Conduction, as in smoothed particle hydrodynamics (Cleary and Monaghan 1999). Heat flows from particle i to particle
// p at the rate k_pi (T_i - T_p), with
//   k_pi = kappa D0 max(0, 1 - D^2/(1.5 D0)^2),
// which is the same for both, so that none is lost. kappa is the harmonic mean of those of the two materials, as in two
// slabs in a row. A lattice with distances x_j along an axis and a volume V a particle conducts like a body of
//   k = sum_j k_j x_j^2 / (2 V),
// and kappa is such that the closest packing of particles that touch has the conductivity of the material.
//
// An obstacle of a given temperature exchanges heat through the half layer between it and the centers of particles that
// touch it: k_o = k A / r, with the area A = 2 sqrt(3) r^2 of a particle in a layer of closest packing. It fades to 0
// at one and a half radii like the conductance of a pair.
//
// The air takes h A_free (T_air - T_p), and radiation eps sigma A_free (T_air^4 - T_p^4), where A_free is the area of a
// particle at the free surface; see freeArea().
#pragma once

#include <cstdint>
#include <vector>

#include "engine/forces/pair_traversal.h"
#include "engine/state/heat.h"

namespace engine {

/// The Stefan-Boltzmann constant, W/(m^2 K^4); exact in SI units since 2019.
inline constexpr double kStefanBoltzmann = 5.670374419e-8;

struct HeatNetwork {
    std::vector<double> conductanceToOthers;  ///< sum over the links of a particle, W/K
    std::vector<double> flowFromOthers;       ///< along them at the temperatures of the moment, W
    std::vector<double> conductanceOutside;   ///< to obstacles and air, W/K
    std::vector<double> inflow;               ///< conductances outside times the temperatures there, W

    // The links themselves, which an explicit exchange does not need. Empty where they have not been found.
    std::vector<std::size_t> begin;    ///< where the links of each own particle begin; one more than particles
    std::vector<std::uint32_t> other;  ///< combined index of the particle at the other end of each link
    std::vector<double> conductance;   ///< of each link, W/K

    bool hasLinks() const { return !begin.empty(); }
};

/// Conductance of a particle and others like it over the conductivity (W/(m K)) and the rest length, at a distance of
/// so many rest lengths; a pure number.
double conductanceAt(double distanceRatio);

/// Conductance between a particle of this conductivity (W/(m K)) and radius (m) and the surface of an obstacle at this
/// distance (m) from its center, W/K.
double conductanceToWall(double conductivity, double radius, double height);

/// What is in the way between a particle and the air, summed over its neighbors and the walls that it touches.
struct Cover {
    Vec3 side = Vec3::Zero();  ///< sum of the weights times unit vectors away from the neighbor
    double weight = 0.0;       ///< sum of the weights; 1 in the inside of closest packing
};

/// Area with which a particle of this radius (m) meets the air, m^2. In a flat surface it is that of a particle in a
/// layer of closest packing, told by the neighbors' being on one side; a particle with less than half of all neighbors
/// has the rest of its own surface, too. Inside, where neighbors are on all sides, it is 0 at any density.
double freeArea(double radius, const Cover& cover);

/// Finds all of a network but the links themselves, for the particles that `pairs` was prepared and packed for. Visits
/// the neighbors of every particle once.
/// @param temperature  in combined order, K; radiation and the flows follow from it
/// @param time         at which the obstacles are where they are, s
void findFlows(const PairTraversal& pairs, const Particles& particles, const Obstacles& obstacles,
               const HeatSetup& heat, const std::vector<double>& temperature, double time, HeatNetwork& network);

/// Adds the links to a network, with two more visits of all neighbors. They take 12 bytes each.
void findLinks(const PairTraversal& pairs, const Particles& particles, HeatNetwork& network);

/// Heat that damping and friction make of each own particle's motion at this moment, W: half of that of its pairs.
std::vector<double> dissipationOf(const PairTraversal& pairs, const Particles& particles);

}  // namespace engine
