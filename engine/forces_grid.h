// The sums over a prepared traversal that ForceEvaluator offers.
#pragma once

#include <vector>

#include "engine/pair_traversal.h"

namespace engine {

/// The pair force on every particle, in newtons, by particle index; forces has their number of entries.
void pairForces(const PairTraversal& pairs, std::vector<Vec3>& forces);

/// Pair energy of the conservative part, in joules.
double pairEnergySum(const PairTraversal& pairs);

}  // namespace engine
