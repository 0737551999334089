// Conjugate gradients as in Hestenes and Stiefel 1952. Sums are exact until they are rounded, so that they do not
// depend on the numbers of threads and ranks.
#include "engine/forces/conjugate_gradient.h"

#include <algorithm>

#include "engine/ranks/exact_sums.h"

#include "engine/core/parallel.h"

namespace engine {
namespace {

/// Largest number of iterations of a solve. Chosen: far more than a step of useful length needs. The energy check after
/// the step judges the result.
constexpr int kMostIterations = 500;

}  // namespace

int solve(PairMatrix& matrix, const std::vector<Vec3>& b, const Tolerance& tolerance, std::vector<Vec3>& x,
          SolverScratch& scratch) {
    const std::size_t count = matrix.count();
    const Ranks& ranks = *matrix.ranks;
    std::vector<Vec3>& residual = scratch.residual;
    std::vector<Vec3>& direction = scratch.direction;
    std::vector<Vec3>& product = scratch.product;
    for (std::vector<Vec3>* of : {&x, &residual, &direction}) of->resize(count);
    const auto termOfNorm = [&](std::size_t p) { return squaredLength(residual[p]) / matrix.mass[p]; };
    double norm = exactSum(ranks, count, [&](std::size_t p) {
        x[p] = Vec3::Zero();
        residual[p] = b[p];
        direction[p] = residual[p] / matrix.mass[p];
        return termOfNorm(p);
    });
    const auto squared = [](double value) { return value * value; };
    const double target = std::max(squared(tolerance.relative) * norm,
                                   std::min(squared(tolerance.absolute), squared(kMostLeftOut) * norm));
    int iteration = 0;
    while (norm > target && iteration < kMostIterations) {
        if (ranks.areMany()) matrix.fetchGhosts(direction);
        multiply(matrix, direction, product);
        for (const std::uint32_t ghost : matrix.ghosts) product[ghost] = Vec3::Zero();
        ++iteration;
        const double curvature = exactSum(ranks, count, [&](std::size_t p) { return dot(direction[p], product[p]); });
        if (!(curvature > 0.0)) break;  // only rounding is left, or NaN; the check after the step decides
        const double length = norm / curvature;
        const double before = norm;
        norm = exactSum(ranks, count, [&](std::size_t p) {
            x[p] += length * direction[p];
            residual[p] -= length * product[p];
            return termOfNorm(p);
        });
        const double share = norm / before;
        inParallel(count, kParticleGrain,
                   [&](std::size_t p) { direction[p] = residual[p] / matrix.mass[p] + share * direction[p]; });
    }
    return iteration;
}

}  // namespace engine
