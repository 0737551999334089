// Conjugate gradient solver for the linear system of an implicit step. Called by stepping/implicit_step.cpp.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"

namespace engine {

/// Work vectors of the solver, kept between solves so that their memory is used again.
struct SolverScratch {
    std::vector<Vec3> residual;
    std::vector<Vec3> direction;
    std::vector<Vec3> product;
};

/// Stopping criterion of the solver. The residual r is measured by sqrt(r . M^-1 r), with the mass matrix M, and may be
/// as large as the larger one of two limits. The absolute limit counts as at most kMostLeftOut times the norm of the
/// right-hand side.
struct Tolerance {
    double relative = 0.0;  ///< largest norm of the residual, as a share of the right-hand side's
    double absolute = 0.0;  ///< largest norm of the residual, kg^1/2 m/s
};

/// Upper bound on an absolute tolerance, as a share of the norm of the right-hand side. Chosen: a residual that is left
/// at every step must stay small beside the forces that drive the motion.
inline constexpr double kMostLeftOut = 0.1;

/// Solves A x = b by conjugate gradients from x = 0, preconditioned with the mass matrix M, and returns the number of
/// products with A. In the rows of ghosts, b must be zero and x has no meaning. If the impulses b change neither linear
/// nor angular momentum, neither do M x (to rounding), at any tolerance: every vector of the iteration is M^-1 times a
/// sum of pair impulses. Other preconditioners do not have this property.
int solve(PairMatrix& matrix, const std::vector<Vec3>& b, const Tolerance& tolerance, std::vector<Vec3>& x,
          SolverScratch& scratch);

}  // namespace engine
