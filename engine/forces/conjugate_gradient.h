// Solves A x = b for the matrix of the implicit steppers.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"

namespace engine {

/// Vectors that a solve needs, kept for their memory.
struct SolverScratch {
    std::vector<Vec3> residual;
    std::vector<Vec3> direction;
    std::vector<Vec3> product;
};

/// When a residual is small enough, in the norm of the inverse mass: either will do, the absolute one as long as it is
/// below kMostLeftOut of the right-hand side.
struct Tolerance {
    double relative = 0.0;  ///< share of the right-hand side
    double absolute = 0.0;  ///< of right-hand sides in N s: kg^1/2 m/s
};

/// Chosen: what is left out at every step anew must not be what drives the motion.
inline constexpr double kMostLeftOut = 0.1;

/// Conjugate gradients from x = 0, preconditioned with the mass, until the residual is small enough. Returns the number
/// of products with A.
/// Holds:  where b has neither a total nor a moment, M x has neither, to rounding, at any tolerance: every vector of
///         the iteration is M^-1 times a sum of pair impulses. Any other preconditioner but the mass would lose that.
int solve(PairMatrix& matrix, const std::vector<Vec3>& b, const Tolerance& tolerance, std::vector<Vec3>& x,
          SolverScratch& scratch);

}  // namespace engine
