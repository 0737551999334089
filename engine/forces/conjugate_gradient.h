// Solves A x = b for the matrix of the implicit steppers. Called by stepping/implicit_step.cpp.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"

namespace engine {

/// Vectors that solve() needs, kept to reuse their memory.
struct SolverScratch {
    std::vector<Vec3> residual;
    std::vector<Vec3> direction;
    std::vector<Vec3> product;
};

/// When a residual is small enough, in the norm of the inverse mass: at the larger of the two limits, of which the
/// absolute one counts for no more than kMostLeftOut of the right-hand side.
struct Tolerance {
    double relative = 0.0;  ///< share of the right-hand side
    double absolute = 0.0;  ///< kg^1/2 m/s, for right-hand sides in N s
};

/// Largest share of the right-hand side that an absolute tolerance may leave out. Chosen: a residual that is left out
/// again at every step must stay small beside what drives the motion.
inline constexpr double kMostLeftOut = 0.1;

/// Conjugate gradients from x = 0, preconditioned with the mass, until the residual is small enough. Returns the number
/// of products with A. Where b has neither a total nor a moment, M x has neither, to rounding, at any tolerance: every
/// vector of the iteration is M^-1 times a sum of pair impulses. Any preconditioner but the mass would lose that.
int solve(PairMatrix& matrix, const std::vector<Vec3>& b, const Tolerance& tolerance, std::vector<Vec3>& x,
          SolverScratch& scratch);

}  // namespace engine
