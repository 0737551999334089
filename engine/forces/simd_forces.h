// Equation 1 for particles of one material and one radius, one particle in each SIMD lane: the fast path of sumPairs().
// In double the forces have the bits of the scalar path, the energies agree to rounding; in float everything is
// computed in float.
#pragma once

#include <array>
#include <cstdint>

#include "engine/forces/pair_sums.h"

namespace engine {

/// What a cluster's particles get from their pairs, by lane.
struct ClusterSums {
    std::array<double, kClusterSize> x, y, z;  ///< force, N
    std::array<double, kClusterSize> energy;   ///< half of the pairs' energies, J
    /// One bit for each lane: whether a neighbor has the same position, as far as the packed particles tell. In double,
    /// also where P.P underflows to 0.
    std::uint32_t coincident = 0;
};

/// Sums over the pairs of the particles in one cluster. A matrix has room for its rows already.
using ClusterKernel = void (*)(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster,
                               ClusterSums& sums);

/// The kernel for a pass, compiled for the machine's instruction set and for the terms and sums that the pass needs.
ClusterKernel clusterKernel(const PairTraversal& pairs, const PairSums& wanted);

/// The instruction set that kernels run on, for example "AVX2".
const char* simdInstructionSet();

}  // namespace engine
