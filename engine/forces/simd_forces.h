// Equation 1 for particles of one material and one radius, a particle a lane: the fast path of addUpPairs. In double
// the forces are bit for bit the scalar kernel's, the energies up to rounding; in float all is that arithmetic's.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/forces/packed_particle.h"
#include "engine/forces/pair_matrix.h"
#include "engine/law/pair_law.h"
#include "engine/neighbors/neighbor_rows.h"

namespace engine {

/// One pass over clusters of particles.
struct SimdPass {
    const NeighborRows& rows;
    const std::vector<PackedParticle>& packed;             ///< read in double
    const std::vector<PackedParticleFloat>& packedFloats;  ///< read in float; empty: in double
    double unit = 1.0;                                     ///< of the positions that are read, m
    PairConstants<double> constants;
    PairTerms terms;
    bool energy = false;
    PairMatrix* matrix = nullptr;  ///< with room for the rows; takes the energy with it
    MatrixWeights weights = {};    ///< of the matrix
};

/// Forces (N) and, where asked for, half of the pair energies (J) of a cluster's particles, by laneSlot.
struct ClusterSums {
    std::array<double, kClusterSize> x, y, z, energy;
    /// A bit each: shares its position with another, as its record tells; in double also who is so near that P.P is 0.
    std::uint32_t coincident = 0;
};

void addUpCluster(const SimdPass& pass, std::size_t cluster, ClusterSums& sums);

/// Of the vectors that this machine runs: "AVX2", for example.
const char* simdInstructionSet();

}  // namespace engine
