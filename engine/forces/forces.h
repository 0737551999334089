// Forces on all particles: equation 1 over the pair law, plus gravity and obstacles. There are two ways to the same
// sum: the O(n^2) reference, which is the paper's own way, and a neighbor list, which is O(n), threaded and compiled
// with only the terms that the materials need. Used by every stepper (engine/stepping) through the step cache.
#pragma once

#include <vector>

#include "engine/forces/force_law.h"
#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_traversal.h"
#include "engine/state/setup.h"

namespace engine {

/// The pair forces of equation 1, in newtons, by every pair in double. All other paths are tested against it; it is
/// kept obvious and never optimized.
/// @param velocities  seen by the damping and the friction, in m/s
void pairForcesReference(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                         std::vector<Vec3>& forces);

/// Energy of the conservative part of the force between particles p and i, in joules.
double pairEnergyReference(const ForceLaw& law, const Particles& particles, std::size_t p, std::size_t i);

/// Sum of the energies of all pairs, in joules.
double pairEnergyReference(const ForceLaw& law, const Particles& particles);

/// Evaluates forces, and keeps the neighbor list and all memory from one evaluation to the next. Results have the same
/// bits for any number of threads. In all functions `velocities` are those that damping and friction see (m/s), and
/// `step` is the time (s) until the next evaluation, from which the skin of a new neighbor list is chosen; 0 if
/// unknown.
class ForceEvaluator {
 public:
    ForceEvaluator() = default;
    ForceEvaluator(ForceLaw law, ForceMethod method, Precision precision = Precision::doubles);

    /// The pair forces of equation 1 alone. The paper's stepper adds addExternalForces() to them.
    void evaluatePairs(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                       double step = 0.0);

    /// Pairs and gravity without the obstacles, for steppers that sweep the contacts. Returns the pair energy, J.
    double evaluateFree(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                        double step = 0.0);

    /// evaluateFree() with the particles' velocities, and the matrix of the implicit steppers in the order of order().
    double assemble(const Particles& particles, const MatrixWeights& weights, std::vector<Vec3>& forces,
                    PairMatrix& matrix, double step = 0.0);

    /// Particle index at each sorted index of the neighbor list, hence of the matrix that was assembled last.
    const std::vector<std::uint32_t>& order() const { return pairs_.list.order; }

    /// The neighbor list as it was last built.
    const NeighborList& list() const { return pairs_.list; }

    /// Whether forces are summed over the neighbor list; the reference needs none.
    bool needsList() const { return method_ == ForceMethod::grid; }

    /// Brings the neighbor list up to date if the method needs one.
    void renewList(const Particles& particles);

    /// Discards the neighbor list. To be called when particles have got other indices.
    void forgetList();

    /// Rebuilds the neighbor list of a resumed run.
    /// @param builtAt  positions that the list was built for, m
    /// @param reach    distance within which it lists neighbors (cutoff and skin together), m
    void restoreList(const std::vector<Vec3>& builtAt, double reach) { build(pairs_.list, builtAt, reach, 0.0); }

    /// Whether no particle in p's row of the list is within a cutoff (m) at these positions (m). If the list covers the
    /// positions, that is every particle. False for a particle emitted since the list was built: it has no row.
    /// @param cachedNeighbor  tried first; set to the neighbor that was found. Any value is valid on entry, and the
    ///                        answer does not depend on it.
    bool hasNoNeighborWithin(const std::vector<Vec3>& positions, double cutoff, std::size_t p,
                             std::uint32_t& cachedNeighbor) const;

    /// Pair energy of the conservative part over the neighbor list, in joules.
    double pairEnergyGrid(const Particles& particles);

    const ForceLaw& law() const { return law_; }

 private:
    void addGravity(const Particles& particles, std::vector<Vec3>& forces) const;

    ForceLaw law_;
    ForceMethod method_ = ForceMethod::grid;
    PairTraversal pairs_;
};

}  // namespace engine
