// Equation 1 for particles of one material and one radius, one particle in each SIMD lane: the fast path of sumPairs().
// In double the forces have the bits of the scalar path, the energies agree to rounding; in float everything is
// computed in float.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/forces/packed_particles.h"
#include "engine/forces/pair_matrix.h"
#include "engine/law/pair_law.h"
#include "engine/neighbors/neighbor_rows.h"

namespace engine {

/// One pass over all clusters.
struct SimdPass {
    const NeighborRows& rows;
    const std::vector<PackedParticle>& packed;            ///< read in double
    const std::vector<PackedParticleFloat>& packedFloat;  ///< read in float; empty in double
    double unit = 1.0;                                    ///< length of a unit of the positions that are read, m
    PairConstants<double> constants;                      ///< of every pair
    PairTerms terms;
    bool hasEnergy = false;        ///< whether energies are summed, too
    PairMatrix* matrix = nullptr;  ///< with room for its rows; needs hasEnergy
    MatrixWeights weights = {};    ///< of the matrix
};

/// What a cluster's particles get from their pairs, by lane.
struct ClusterSums {
    std::array<double, kClusterSize> x, y, z;  ///< force, N
    std::array<double, kClusterSize> energy;   ///< half of the pairs' energies, J
    /// One bit for each lane: whether a neighbor has the same position, as far as the packed particles tell. In double,
    /// also where P.P underflows to 0.
    std::uint32_t coincident = 0;
};

using ClusterKernel = void (*)(const SimdPass& pass, std::size_t cluster, ClusterSums& sums);

/// The kernel for a pass, compiled for the machine's instruction set and for the terms and sums that the pass needs.
ClusterKernel clusterKernel(const SimdPass& pass);

/// The instruction set that kernels run on, for example "AVX2".
const char* simdInstructionSet();

}  // namespace engine
