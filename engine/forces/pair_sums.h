// The sums of one pass over all pairs of particles: the forces and, if requested, the pair energy and the matrix of the
// implicit steppers. Called by ForceEvaluator and stepping/step_bound.cpp.
#pragma once

#include <vector>

#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_traversal.h"

namespace engine {

/// Where a pass over all pairs writes its results. A sum whose pointer is nullptr is not computed.
struct PairSums {
    std::vector<Vec3>& forces;     ///< force on each particle, by particle index, N; has the right size already
    double* energy = nullptr;      ///< energy of all pairs (conservative part of the force), J
    PairMatrix* matrix = nullptr;  ///< matrix of the implicit steppers
    MatrixWeights weights = {};    ///< factors of damping and stiffness in the matrix
};

/// The terms and the sums that a kernel over pairs is compiled with.
struct Variant {
    PairTerms terms;
    bool hasEnergy;
    bool hasMatrix;
};

/// Calls visit.operator()<variant>() with the cheapest compiled variant of a kernel that has the needed terms and
/// computes the wanted sums, and returns the result of visit. A kernel that assembles a matrix also sums the energy.
template <class Visit>
auto withVariant(PairTerms needed, const PairSums& wanted, const Visit& visit) {
    return withTerms(needed, [&]<PairTerms terms>() {
        if (wanted.matrix != nullptr) return visit.template operator()<Variant{terms, true, true}>();
        if (wanted.energy != nullptr) return visit.template operator()<Variant{terms, true, false}>();
        return visit.template operator()<Variant{terms, false, false}>();
    });
}

/// Sums forces, and what else is wanted, over all pairs of a prepared traversal.
/// @pre with a matrix, pairs.isPacked
void sumPairs(const PairTraversal& pairs, const PairSums& wanted);

/// Sum of the energies of all pairs (conservative part of the force) without any forces, in joules.
/// @pre pairs.isPacked
double pairEnergySum(const PairTraversal& pairs);

}  // namespace engine
