// Forces on all particles: equation 1 over the pair law, plus gravity and obstacles. Two ways to the same sum: the
// O(n^2) reference, which is the paper's own way, and a neighbor list, O(n), threaded, that compiles in only the terms
// the materials need.
#pragma once

#include <vector>

#include "engine/forces/force_law.h"
#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_sums.h"
#include "engine/forces/pair_traversal.h"
#include "engine/state/setup.h"

namespace engine {

/// The pair forces of equation 1, in newtons, by every pair in double. The oracle of every faster way; never optimized.
/// Shape:  velocities and forces as particles.position; velocities are those the damping sees (m/s).
void pairForcesReference(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                         std::vector<Vec3>& forces);

/// Energy of the conservative block of one pair, in joules.
double pairEnergyReference(const ForceLaw& law, const Particles& particles, std::size_t p, std::size_t i);

/// The same of every pair.
double pairEnergyReference(const ForceLaw& law, const Particles& particles);

/// Evaluates forces again and again and keeps the memory it needs for that.
class ForceEvaluator {
 public:
    ForceEvaluator() = default;
    ForceEvaluator(ForceLaw law, ForceMethod method, Precision precision = Precision::doubles);

    /// Total force on every particle, in newtons, with the given velocities (m/s) in the damping; obstacles included.
    /// Holds:  the same bits for any number of threads.
    /// Shape:  step: s until the next evaluation, which the neighbor list is to serve too; 0: nobody knows.
    void evaluate(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                  double step = 0.0);

    /// The pair forces of equation 1 alone; what evaluate adds to them are outer forces (outer_forces.h).
    void evaluatePairs(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                       double step = 0.0);

    /// The same as evaluate without the obstacles, for steppers that sweep the contacts; returns the pair energy, J.
    double evaluateFree(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                        double step = 0.0);

    /// evaluateFree, and the matrix of the implicit steppers at the particles' positions, in the order of order().
    double assemble(const Particles& particles, const MatrixWeights& weights, std::vector<Vec3>& forces,
                    PairMatrix& matrix, double step = 0.0);

    /// Particle index at each sortedIndex of the matrix that was assembled last.
    const std::vector<std::uint32_t>& order() const { return pairs_.list.order; }

    /// The neighbor list as it was built last.
    const NeighborList& list() const { return pairs_.list; }

    /// Whether forces are summed over the list; the reference needs none.
    bool needsList() const { return method_ == ForceMethod::grid; }

    /// Brings the list up to date without a sum over it, where forces need one.
    void renewList(const Particles& particles);

    /// Particles have other indices now: the list serves nobody any more.
    void forgetList() { pairs_.forgetList(); }

    /// Brings back a list by what it was built for, as of a run that is gone on with.
    void restoreList(const std::vector<Vec3>& builtAt, double reach) { pairs_.restoreList(builtAt, reach); }

    /// Whether nobody in a particle's row of the list is within a cutoff (m), at these positions (m): nobody at all, as
    /// long as the list covers them. False for a newborn, which is in no row and may have been placed beside anyone.
    /// Holds:  as long as the list covers the positions the same answer whoever is looked at first.
    /// Shape:  cachedNeighbor: who that is, any number; becomes whoever is found: company that stays needs no search.
    bool hasNoNeighborWithin(const std::vector<Vec3>& positions, double cutoff, std::size_t p,
                             std::uint32_t& cachedNeighbor) const;

    /// The pair forces of equation 1 alone, over the neighbor list.
    void pairForcesGrid(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                        double step = 0.0);

    /// Pair energy of the conservative block, in joules, over the neighbor list.
    double pairEnergyGrid(const Particles& particles);

    const ForceLaw& law() const { return law_; }

 private:
    void addGravity(const Particles& particles, std::vector<Vec3>& forces) const;

    ForceLaw law_;
    ForceMethod method_ = ForceMethod::grid;
    PairTraversal pairs_;
};

}  // namespace engine
