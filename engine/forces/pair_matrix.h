// The matrix of the implicit steppers: A = M + C' + K', where M is the mass, C' the weighted damping and K' the
// weighted stiffness of all pairs of particles at their present positions. Damping and stiffness act along the line
// between two particles; friction adds weighted damping across this line. The matrix is stored as one number for each
// pair, or two with friction, and multiplying by it is another pass over the pairs. Assembled by sumPairs(), used by
// conjugate_gradient.cpp and stepping/step_bound.cpp.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/forces/packed_particles.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/ranks/ranks.h"

namespace engine {

/// Factors of the damping and of the stiffness in the matrix of an implicit step: h/2 and h^2/4 for a time step h.
struct MatrixWeights {
    double damping = 0.0;    ///< s
    double stiffness = 0.0;  ///< factor of the stiffness, s^2; 0 for a matrix without
};

/// The matrix of an implicit step as rows of neighbors. The 3x3 block of a pair with separation P is -(along P P^T +
/// across 1), and both blocks of a pair are equal bit for bit. Coincident particles, whose separation has no direction,
/// have no block. All arrays are in the order of the neighbor list from which the matrix was assembled.
struct PairMatrix {
    /// One number for each entry of the neighbor rows, in a vector for each block of rows.
    using Entries = std::vector<std::vector<double>>;

    const Ranks* ranks = &Ranks::alone();  ///< the processes that share the particles
    std::vector<double> mass;              ///< mass of each particle, kg
    std::vector<Matrix3> own;              ///< terms of obstacles in the particles' diagonal blocks, kg; may be empty
    std::vector<PackedParticle> packed;    ///< positions; the velocities hold the vector x of a product A x
    NeighborRows rows;                     ///< neighbors with an entry in the matrix, for each particle
    Entries along;                         ///< coefficients of P P^T, kg/m^2
    Entries across;                        ///< coefficients of the unit matrix, kg; empty without friction
    std::vector<std::uint32_t> ghosts;     ///< rows of particles of other ranks, without entries
    /// Fetches the parts of a vector that belong to ghosts from their ranks; only with many ranks.
    std::function<void(std::vector<Vec3>&)> fetchGhosts;

    std::size_t count() const { return mass.size(); }

    /// Appends an entry to the row of the particle in a lane slot of the neighbor list. Threads may append to different
    /// rows at the same time.
    void add(std::size_t laneSlot, std::uint32_t other, double alongOf, double acrossOf);
};

/// Empties the matrix and makes room for as many entries as a neighbor list has.
void makeRoom(PairMatrix& matrix, const NeighborList& list, bool hasFriction);

/// Pads the rows of each cluster to the same length with zeros. To be called after the last entry was added.
void padRows(PairMatrix& matrix);

/// Computes product = A x, where both vectors have an entry for each particle. The part of the product that comes from
/// pairs adds up to no net impulse and no net angular impulse, to rounding.
void multiply(PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product);

}  // namespace engine
