// The system of an implicit step, with many ranks and a tolerance of its own.
#include "engine/forces/conjugate_gradient.h"

#include <algorithm>

namespace engine {

int solve(PairMatrix& matrix, const std::vector<Vec3>& b, const Tolerance& tolerance, std::vector<Vec3>& x,
          SolverScratch& scratch) {
    const Ranks& ranks = *matrix.ranks;
    const auto multiplyHere = [&](std::vector<Vec3>& direction, std::vector<Vec3>& product) {
        if (ranks.areMany()) matrix.fetchGhosts(direction);
        multiply(matrix, direction, product);
        for (const std::uint32_t ghost : matrix.ghosts) product[ghost] = Vec3::Zero();
    };
    const auto squared = [](double value) { return value * value; };
    const auto target = [&](double norm) {
        return std::max(squared(tolerance.relative) * norm,
                        std::min(squared(tolerance.absolute), squared(kMostLeftOut) * norm));
    };
    return solveByGradients(ranks, b, matrix.mass, multiplyHere, target, x, scratch);
}

}  // namespace engine
