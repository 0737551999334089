// What one pass over all pairs adds up: forces, and where someone asks for them the pair energy and the matrix of the
// implicit steppers. Used by ForceEvaluator.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_traversal.h"

namespace engine {

/// The sums of a pass over a prepared traversal; nullptr leaves one out, and out of the kernel.
struct PairSums {
    std::vector<Vec3>& forces;     ///< N, by particle index; has their number of entries
    double* energy = nullptr;      ///< J, of the conservative block
    PairMatrix* matrix = nullptr;  ///< in the order of the traversal's list
    MatrixWeights weights = {};    ///< of the matrix
};

/// Adds up what is wanted.  \pre  with a matrix, there are packed.
void addUpPairs(const PairTraversal& pairs, const PairSums& wanted);

/// Pair energy of the conservative block alone, in joules.  \pre  there are packed.
double pairEnergySum(const PairTraversal& pairs);

}  // namespace engine
