// Everything that acts on particles, and which of its terms the particles at hand need. Filled from a Setup by the
// steppers; read by all of engine/forces.
#pragma once

#include <vector>

#include "engine/law/material.h"
#include "engine/law/obstacles.h"
#include "engine/law/pair_law.h"
#include "engine/state/particles.h"
#include "engine/state/setup.h"

namespace engine {

/// Everything that acts on particles.
struct ForceLaw {
    std::vector<Material> materials;
    Vec3 gravity = Vec3::Zero();  ///< m/s^2
    Obstacles obstacles;
};

/// The part of a setup that acts on particles.
inline ForceLaw lawOf(const Setup& setup) {
    return {setup.materials, setup.gravity, setup.obstacles};
}

/// What the pairs of a set of particles need. Their kernel is compiled without all other terms.
struct ForceTerms {
    PairTerms pair{.attraction = false, .damping = false, .friction = false};
    bool uniform = true;  ///< whether all particles have one law and one radius, hence all pairs the same constants
    double cutoff = 0.0;  ///< no pair acts at or beyond it, m
};

/// The largest cutoff that a pair of these materials can have, in rest lengths (sums of the two radii).
double cutoffRatio(const std::vector<Material>& materials);

ForceTerms termsFor(const ForceLaw& law, const Particles& particles);

/// mixed() of every material with every other, in row-major order: materials.size() squared entries. Materials with the
/// same law are not mixed, so that their pairs have exactly its constants.
std::vector<Material> mixedPairs(const std::vector<Material>& materials);

}  // namespace engine
