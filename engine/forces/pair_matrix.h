// The matrix of the implicit steppers, never formed: A = M + C' + K', where M is the mass, C' the weighted damping and
// K' the weighted stiffness of all pairs at one configuration. Both act along the line between two particles; friction
// adds weighted damping across it. Each pair is stored as one number, with friction two; a product is another pass over
// the pairs. Assembled by sumPairs(), used by conjugate_gradient.cpp and stepping/step_bound.cpp.
#pragma once

#include <vector>

#include "engine/core/vec3.h"
#include "engine/forces/packed_particles.h"
#include "engine/neighbors/neighbor_list.h"

namespace engine {

/// How much of the damping and of the stiffness enters: h/2 and h^2/4 for a step h.
struct MatrixWeights {
    double damping = 0.0;    ///< s
    double stiffness = 0.0;  ///< s^2; 0 leaves the stiffness out
};

/// The block of a pair is -(along P P^T + across 1). The two entries of a pair are equal bit for bit. Coincident pairs,
/// which have no direction, add nothing. All vectors are in the order of the neighbor list that the matrix was
/// assembled over.
struct PairMatrix {
    /// A number for each entry of the rows, by block.
    using Entries = std::vector<std::vector<double>>;

    std::vector<double> mass;  ///< of each particle, kg
    std::vector<Matrix3> own;  ///< what obstacles add to each particle's diagonal block, kg; empty without any
    std::vector<PackedParticle> packed;  ///< positions; a product stores its factor as the velocities
    NeighborRows rows;                   ///< of the pairs that have an entry
    Entries along;                       ///< kg/m^2
    Entries across;                      ///< kg; empty without friction

    std::size_t count() const { return mass.size(); }

    /// Appends an entry to the row of a lane slot. Threads may append to different rows at the same time.
    void add(std::size_t laneSlot, std::uint32_t other, double alongOf, double acrossOf);
};

/// Empties the matrix and makes room for the pairs of a list.
void makeRoom(PairMatrix& matrix, const NeighborList& list, bool hasFriction);

/// Pads the rows after the last entry was added.
void padRows(PairMatrix& matrix);

/// product = A x, both of count() entries. The pairs' part of the product has neither a total nor a moment, to
/// rounding.
void multiply(PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product);

}  // namespace engine
