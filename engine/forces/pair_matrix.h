// The matrix of the implicit steppers, never formed: A = M + C' + K', where M is the mass, C' the weighted damping and
// K' the weighted stiffness of all pairs at one configuration, both acting along the line between the two; friction
// adds weighted damping across it. Each entry is kept as a number: a product is another pass over the pairs, with what
// is multiplied in the sortedIndex of the velocities.
#pragma once

#include <array>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/forces/packed_particle.h"
#include "engine/neighbors/neighbor_list.h"

namespace engine {

/// How much of the damping and of the stiffness enters: h/2 and h^2/4 of a step h.
struct MatrixWeights {
    double damping = 0.0;    ///< s
    double stiffness = 0.0;  ///< s^2; 0 leaves the stiffness out
};

/// All vectors are by sortedIndex in the neighbor list that it was assembled over. The block of a pair is
/// -(along P P^T + across 1), its two entries are equal bit for bit. Coincident pairs, which have no direction, add
/// nothing.
struct PairMatrix {
    std::vector<double> mass;  ///< of each particle, kg
    std::vector<Matrix3> own;  ///< what obstacles add to each particle's own block, kg; empty without any
    std::vector<PackedParticle>
        packed;         ///< positions; a product puts what it multiplies in the sortedIndex of the velocities
    NeighborRows rows;  ///< of the pairs that have an entry

    /// Of each entry of a block of the rows.
    using Entries = std::vector<std::vector<double>>;

    Entries along;   ///< kg/m^2
    Entries across;  ///< kg; empty without friction

    std::size_t count() const { return mass.size(); }

    /// Appends an entry to the row of a laneSlot; the laneSlot's own thread alone may.
    void add(std::size_t laneSlot, std::uint32_t other, double alongOf, double acrossOf);
};

/// Empties the matrix and gives it room for the pairs of a list.
void makeRoom(PairMatrix& matrix, const NeighborList& list, bool hasFriction);

/// Fills the rows up, after the last entry.
void close(PairMatrix& matrix);

/// product = A x, both of count() entries.
/// Holds: what the pairs add has neither a total nor a moment, to rounding.
void multiply(PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product);

/// The pairs' share of a product for the particles of one cluster, by laneSlot.
struct ClusterProduct {
    std::array<double, kClusterSize> x, y, z;
};

/// Sum over the others of along P (P . d) + across d, where d is what the packed' velocities differ by; a particle a
/// lane. Called by multiply().
void multiplyCluster(const PairMatrix& matrix, std::size_t cluster, ClusterProduct& product);

}  // namespace engine
