// Conjugate gradient solvers: for the linear system of an implicit step, called by stepping/implicit_step.cpp, and for
// any symmetric positive definite system. As in Hestenes and Stiefel 1952. Sums are exact until they are rounded, so
// that they do not depend on the numbers of threads and ranks.
#pragma once

#include <vector>

#include "engine/core/parallel.h"
#include "engine/forces/pair_matrix.h"
#include "engine/ranks/exact_sums.h"

namespace engine {

/// Work vectors of a solver, kept between solves so that their memory is used again.
/// @tparam Value  double or Vec3
template <class Value>
struct GradientScratch {
    std::vector<Value> residual;
    std::vector<Value> direction;
    std::vector<Value> product;
};
using SolverScratch = GradientScratch<Vec3>;

/// Largest number of iterations of a solve. Chosen: far more than a step of useful length needs.
inline constexpr int kMostIterations = 500;

/// The product of two entries of vectors of numbers, as dot() is that of two vectors of Vec3.
inline double dot(double a, double b) {
    return a * b;
}

inline double zeroOf(const std::vector<double>& /*vector*/) {
    return 0.0;
}

inline Vec3 zeroOf(const std::vector<Vec3>& /*vector*/) {
    return Vec3::Zero();
}

/// Solves A x = b by conjugate gradients from x = 0, preconditioned with a diagonal matrix M, and returns the number of
/// products with A.
/// @param multiply  multiply(vector, product) computes A times a vector, on all ranks
/// @param target    target(norm) returns the largest squared norm of the residual, r . M^-1 r, from that of b
template <class Value, class Multiply, class Target>
int solveByGradients(const Ranks& ranks, const std::vector<Value>& b, const std::vector<double>& diagonal,
                     const Multiply& multiply, const Target& target, std::vector<Value>& x,
                     GradientScratch<Value>& scratch) {
    const std::size_t count = b.size();
    std::vector<Value>& residual = scratch.residual;
    std::vector<Value>& direction = scratch.direction;
    std::vector<Value>& product = scratch.product;
    for (std::vector<Value>* of : {&x, &residual, &direction}) of->resize(count);
    const auto termOfNorm = [&](std::size_t p) { return dot(residual[p], residual[p]) / diagonal[p]; };
    double norm = exactSum(ranks, count, [&](std::size_t p) {
        x[p] = zeroOf(x);
        residual[p] = b[p];
        direction[p] = residual[p] / diagonal[p];
        return termOfNorm(p);
    });
    const double enough = target(norm);
    int iteration = 0;
    while (norm > enough && iteration < kMostIterations) {
        multiply(direction, product);
        ++iteration;
        const double curvature = exactSum(ranks, count, [&](std::size_t p) { return dot(direction[p], product[p]); });
        if (!(curvature > 0.0)) break;  // only rounding is left, or NaN; the caller judges the result
        const double length = norm / curvature;
        const double before = norm;
        norm = exactSum(ranks, count, [&](std::size_t p) {
            x[p] += length * direction[p];
            residual[p] -= length * product[p];
            return termOfNorm(p);
        });
        const double share = norm / before;
        inParallel(count, kParticleGrain,
                   [&](std::size_t p) { direction[p] = residual[p] / diagonal[p] + share * direction[p]; });
    }
    return iteration;
}

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
