// Forces on all particles: equation 1 over the pair law, plus gravity and obstacles. Two ways to the same sum: the O(n^2)
// reference, which is the paper's own way, and a cell grid, O(n), threaded, that compiles in only the terms the materials need.
#pragma once

#include <vector>

#include "engine/colliders.h"
#include "engine/material.h"
#include "engine/neighbours.h"
#include "engine/pair_law.h"
#include "engine/particles.h"

namespace engine {

enum class ForceMethod {
    reference,  ///< every pair, serial: the paper's way
    grid        ///< pairs of neighbouring cells, threaded
};

/// Everything that acts on particles.
struct ForceLaw {
    std::vector<Material> materials;
    Vec3 gravity = Vec3::Zero();    ///< m/s^2
    Scenery scenery;
};

/// What some pair of the particles needs; the rest is not compiled into their kernel.
struct ForceTerms {
    PairTerms pair{.attraction = false, .damping = false};
    bool uniform = true;            ///< one law and one radius: constants are not looked up per pair
    double cutoff = 0.0;            ///< no pair acts at or beyond it, m
};

ForceTerms termsFor(const ForceLaw& law, const Particles& particles);

/// Every particle's material against every other's, mixed once. Row-major, materials.size() squared.
std::vector<Material> mixedPairs(const std::vector<Material>& materials);

/// The pair forces of equation 1, in newtons, by every pair in double. The oracle of every faster way; never optimised.
/// Shape:  velocities and forces as particles.position; velocities are those the damping sees (m/s).
void pairForcesReference(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                         std::vector<Vec3>& forces);

/// Pair energy of the conservative part, in joules, by every pair.
double pairEnergyReference(const ForceLaw& law, const Particles& particles);

/// A particle as the grid kernel reads it, in cell order; one cache line.
struct alignas(64) PairRecord {
    double x, y, z;
    double vx, vy, vz;
    double radius;
    std::uint32_t material;
    std::uint32_t id;
};

/// Evaluates forces again and again and keeps the memory it needs for that.
class ForceEvaluator {
   public:
    ForceEvaluator() = default;
    ForceEvaluator(ForceLaw law, ForceMethod method);

    /// Total force on every particle, in newtons, with the given velocities (m/s) in the damping.
    /// Holds:  the same bits for any number of threads.
    void evaluate(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces);

    /// The pair forces of equation 1 alone, over the cell grid.
    void pairForcesGrid(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces);

    /// Pair energy of the conservative part, in joules, over the cell grid.
    double pairEnergyGrid(const Particles& particles);

    const ForceLaw& law() const { return law_; }

   private:
    void sortIntoCells(const Particles& particles, const std::vector<Vec3>& velocities, double cutoff);

    ForceLaw law_;
    ForceMethod method_ = ForceMethod::grid;
    std::vector<Material> pairs_;       ///< mixedPairs of the law's materials
    CellGrid grid_;
    std::vector<PairRecord> records_;   ///< in the grid's order
    std::vector<double> energies_;      ///< per particle, in the grid's order
};

}  // namespace engine
