// How far a column of a material sinks under its own weight, and how strong its repulsion has to be for it to sink no
// further than wanted. The result is a closed form, found without a simulation. Called by scenes/ for the key
// material.compression and by `globular check`.
#pragma once

#include <optional>

#include "engine/force_law/material.h"

namespace engine {

/// A column of particles on a floor, between walls without friction, before it sinks.
struct Column {
    double height = 1.0;   ///< m
    double spacing = 0.3;  ///< distance of nearest neighbors, m
    double gravity = 9.8;  ///< m/s^2, at least 0
};

/// Pressure of a face-centered cubic lattice of a material's particles, in pascals; negative where the particles pull
/// on each other.
/// @param spacing  distance of nearest neighbors, in meters; above 1/20 of the radius
double latticePressure(const Material& material, double spacing);

/// Distance of nearest neighbors at which a lattice of the material's particles has no pressure, in meters. It is two
/// radii unless particles attract beyond their nearest neighbors (c_r above the square root of 2).
double restSpacing(const Material& material);

/// Whether a column of the material draws itself together and away from the walls around it, so that its height does
/// not follow from its weight: particles attract beyond their nearest neighbors, and lie further apart than at rest.
bool drawsTogether(const Material& material, const Column& column);

/// The height at which a column of the material comes to rest, as a share of its height before. It is above 1 for a
/// column that starts more closely packed than it comes to rest.
double settledShare(const Material& material, const Column& column);

/// The strength b1 of the repulsion, in N m^4, with which a column of the material comes to rest at a wanted share of
/// its height; nothing if it sinks further however strong the repulsion is, because it starts too loosely packed.
/// @param share  above 0
std::optional<double> repulsionForShare(const Material& material, const Column& column, double share);

}  // namespace engine
