// The matrix of the implicit steppers, never formed: A = M + C' + K', where M is the mass, C' the weighted damping and
// K' the weighted stiffness of all pairs at one configuration, both acting along the line between the two; friction
// adds weighted damping across it. Each pair is kept as one vector q with A_pi = -q q^T, so that a product is two dot
// products a pair.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/vec3.h"

namespace engine {

/// How much of the damping and of the stiffness enters: h/2 and h^2/4 of a step h.
struct MatrixWeights {
    double damping = 0.0;    ///< s
    double stiffness = 0.0;  ///< s^2; 0 leaves the stiffness out
};

/// All vectors are in the order of the neighbour list that it was assembled over.
struct PairMatrix {
    std::vector<double> mass;             ///< of each particle, kg
    std::vector<std::uint32_t> rowStart;  ///< first entry of each row, and one past the last row's room
    std::vector<std::uint32_t> rowEnd;    ///< one past the last entry of each row
    std::vector<std::uint32_t> other;     ///< place of the other particle of each entry
    std::vector<Matrix3> own;             ///< what obstacles add to each particle's own block, kg; empty without any
    std::vector<double> across;           ///< with friction: weight times c_t of each entry, kg; empty without
    std::vector<Vec3> normal;             ///< with friction: direction of each entry
    std::vector<Vec3> along;              ///< q, kg^(1/2); q of (p, i) is minus that of (i, p), bit for bit

    std::size_t count() const { return mass.size(); }
};

/// product = A x, both of count() entries.
/// Holds: what the pairs add has neither a total nor a moment, to rounding.
void multiply(const PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product);

}  // namespace engine
