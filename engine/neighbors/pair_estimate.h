// Estimates the number of pairs of neighbors from a sample of the particles, where to list all pairs might take more
// time or memory than there is. Used on scenes that were not run yet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Number of particles in a sample that pairs are counted in. Chosen: to list all pairs of so many takes 0.1 s.
inline constexpr double kPairSampleCount = 4000.0;

/// The smallest whole number by which a number has to be divided to be at most a limit.
std::uint64_t strideFor(double number, double most);

/// Indices below `count`, each chosen with a chance of 1 in `stride`, the same in every call. A regular choice would
/// miss pairs in a lattice.
std::vector<std::uint32_t> sampleOf(std::size_t count, std::uint64_t stride);

/// The number of pairs of particles within the cutoff: exact for up to kPairSampleCount particles, and estimated from
/// as many if there are more.
/// @param positions  in meters
/// @param radii      one for each position, m
/// @param cutoff     of a pair of the largest particles, m; the cutoff of others is smaller in proportion to their
/// radii
double estimatePairCount(const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff);

}  // namespace engine
