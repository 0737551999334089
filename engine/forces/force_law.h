// What acts on particles, and which of its terms a set of particles needs.
#pragma once

#include <vector>

#include "engine/law/material.h"
#include "engine/law/obstacles.h"
#include "engine/law/pair_law.h"
#include "engine/state/particles.h"

namespace engine {

/// Everything that acts on particles.
struct ForceLaw {
    std::vector<Material> materials;
    Vec3 gravity = Vec3::Zero();  ///< m/s^2
    Obstacles obstacles;
};

/// What some pair of the particles needs; the rest is not compiled into their kernel.
struct ForceTerms {
    PairTerms pair{.attraction = false, .damping = false, .friction = false};
    bool uniform = true;  ///< one law and one radius: constants are not looked up per pair
    double cutoff = 0.0;  ///< no pair acts at or beyond it, m
};

/// How far a pair of these materials may act on each other, in sums of radii.
double cutoffRatio(const std::vector<Material>& materials);

ForceTerms termsFor(const ForceLaw& law, const Particles& particles);

/// Every particle's material against every other's, mixed once. Row-major, materials.size() squared.
std::vector<Material> mixedPairs(const std::vector<Material>& materials);

}  // namespace engine
