// SIMD kernels of the pair forces (equation 1), with one particle in each SIMD lane. Called by sumPairs(). In double
// precision the forces have the bits of the scalar kernel, and the energies agree to rounding; in single precision
// everything is computed in float.
#pragma once

#include <array>
#include <cstdint>

#include "engine/forces/pair_sums.h"

namespace engine {

/// Sums over the pairs of each particle of a cluster, by lane.
struct ClusterSums {
    std::array<double, kClusterSize> x, y, z;  ///< force, N
    std::array<double, kClusterSize> energy;   ///< half of the energies of each particle's pairs, J
    /// One bit for each lane: whether a neighbor of the particle has the same position, as far as the packed
    /// coordinates tell. In double precision also set where P.P underflows to 0.
    std::uint32_t coincident = 0;
};

/// A kernel that sums over the pairs of the particles in one cluster. If a matrix is wanted, it has room for its rows
/// already.
using ClusterKernel = void (*)(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster,
                               ClusterSums& sums);

/// The kernel for a pass over all pairs, compiled for the instruction set in use and for the terms and sums that the
/// pass needs.
/// @pre pairs.hasLanes()
ClusterKernel clusterKernel(const PairTraversal& pairs, const PairSums& wanted);

/// The same for particles of several laws or radii; called by clusterKernel().
ClusterKernel mixedClusterKernel(const PairTraversal& pairs, const PairSums& wanted);

/// The instruction set that kernels run on, for example "AVX2".
const char* simdInstructionSet();

}  // namespace engine
