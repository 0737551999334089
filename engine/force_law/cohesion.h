// Surface tension. A material with cohesion has a pull between particles beyond their rest length, the formula of which
// is in pair_force-inl.h, and a repulsion that balances the pull at the density of the material without cohesion. Both
// follow in closed form from the lattice of lattice.h, without a simulation. Called by scenes/ for the key
// material.cohesion.
#pragma once

#include <numbers>
#include <optional>

#include "engine/force_law/material.h"

namespace engine {

/// The largest reach c_r of a material with cohesion. Beyond it, particles attract their second neighbors by equation 2
/// already, and no repulsion balances that.
inline constexpr double kMostCohesiveReach = std::numbers::sqrt2;

/// The material with a surface tension: with its pull, its rest ratio and, where the given b1 is too small for the
/// density to stay, another b1. It has no pull where the attraction of c_r alone makes that tension. Nothing if c_r is
/// above kMostCohesiveReach.
/// @param cohesion  surface tension, N/m; 0 for none
std::optional<Material> withCohesion(const Material& material, double cohesion);

/// Surface tension of a material in N/m, as follows from its pull and its repulsion.
double surfaceTension(const Material& material);

/// Capillary length sqrt(sigma/(rho g)) of a material, in meters: about the radius above which its drops are flattened
/// by their own weight.
/// @param gravity  m/s^2, above 0
double capillaryLength(const Material& material, double gravity);

}  // namespace engine
