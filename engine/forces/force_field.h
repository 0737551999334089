// The force field of a run: materials, gravity and obstacles, and which terms of the force law a given set of particles
// needs. Made from a Setup; read by all of engine/forces.
#pragma once

#include <vector>

#include "engine/force_law/material.h"
#include "engine/force_law/pair_law.h"
#include "engine/obstacles/obstacles.h"
#include "engine/ranks/ranks.h"
#include "engine/state/particles.h"
#include "engine/state/setup.h"

namespace engine {

/// Everything that acts on particles.
struct ForceField {
    std::vector<Material> materials;
    Vec3 gravity = Vec3::Zero();  ///< m/s^2
    Obstacles obstacles;
    std::vector<Field> fields = {};  ///< they act between the steps; only their energy is asked for here
};

/// The part of a setup that acts on particles.
inline ForceField forceFieldOf(const Setup& setup) {
    return {setup.materials, setup.gravity, setup.obstacles, setup.fields};
}

/// The terms of the force law that the pairs of a set of particles need. The kernel that sums their forces is compiled
/// with these terms only.
struct ForceTerms {
    PairTerms pair{.attraction = false, .damping = false, .friction = false};
    bool oneLaw = true;          ///< whether all materials have the same force law
    bool oneRadius = true;       ///< whether all particles have the same radius
    double largestRadius = 0.0;  ///< m; 0 without particles
    double cutoff = 0.0;         ///< distance at and beyond which no two particles interact, m

    /// Whether all pairs of particles have the same constants.
    bool uniform() const { return oneLaw && oneRadius; }
};

/// Whether all materials have the same force law.
bool isOneLaw(const std::vector<Material>& materials);

/// The largest cutoff that a pair of these materials can have, in rest lengths (sums of the two radii).
double cutoffRatio(const std::vector<Material>& materials);

/// The terms that the particles of all ranks need.
ForceTerms termsFor(const ForceField& field, const Particles& particles, const Ranks& ranks = Ranks::alone());

/// Up to this many materials, the mixtures of every two of them (see mixed()) are tabulated. A mixture of more
/// materials is computed for each pair of particles that occurs: the table would grow with the square of their number,
/// and reading from a table larger than the cache takes longer. Chosen: the table of 64 materials takes 400 kB.
inline constexpr std::size_t kMostTabulated = 64;

/// The number of mixtures that are tabulated for so many materials.
constexpr std::size_t tabulatedCount(std::size_t materials) {
    return materials <= kMostTabulated ? materials * materials : 0;
}

/// The mixtures of every material with every other, in row-major order; empty above kMostTabulated materials. Two
/// materials with the same force law are not mixed, so that their pairs have exactly the constants of that law.
std::vector<Material> tabulatedMixtures(const std::vector<Material>& materials);

/// The mixture of two materials as in the table.
Material tabulated(const Material& a, const Material& b);

}  // namespace engine
