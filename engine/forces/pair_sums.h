// The sums of one pass over all pairs: forces and, where they are asked for, the pair energy and the matrix of the
// implicit steppers. Called by ForceEvaluator and stepping/step_bound.cpp.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_traversal.h"

namespace engine {

/// The sums of a pass; nullptr leaves one out, and out of the kernel.
struct PairSums {
    std::vector<Vec3>& forces;     ///< N, by particle index; already of the right size
    double* energy = nullptr;      ///< of the conservative part, J
    PairMatrix* matrix = nullptr;  ///< in the order of the neighbor list
    MatrixWeights weights = {};    ///< of the matrix
};

/// What a kernel over pairs is compiled for.
struct Variant {
    PairTerms terms;
    bool hasEnergy;
    bool hasMatrix;
};

/// Calls visit.operator()<variant>() with the leanest variant that has the terms and computes the wanted sums, and
/// returns its result. A kernel that assembles a matrix sums the energy, too.
template <class Visit>
auto withVariant(PairTerms needed, const PairSums& wanted, const Visit& visit) {
    return withTerms(needed, [&]<PairTerms terms>() {
        if (wanted.matrix != nullptr) return visit.template operator()<Variant{terms, true, true}>();
        if (wanted.energy != nullptr) return visit.template operator()<Variant{terms, true, false}>();
        return visit.template operator()<Variant{terms, false, false}>();
    });
}

/// Sums over the pairs of a prepared traversal.
/// @pre with a matrix, pairs.isPacked
void sumPairs(const PairTraversal& pairs, const PairSums& wanted);

/// Pair energy of the conservative part alone, in joules.
/// @pre pairs.isPacked
double pairEnergySum(const PairTraversal& pairs);

}  // namespace engine
