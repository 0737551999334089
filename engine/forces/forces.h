// Pair forces and gravity on all particles (equation 1 of the paper). The same sum is computed in two ways: by the
// O(n^2) reference, which is the paper's own way, and over a neighbor list, which is O(n), threaded and compiled with
// only those terms that the materials need. Used by every stepper (engine/stepping) through the step cache.
#pragma once

#include <utility>
#include <vector>

#include "engine/forces/force_field.h"
#include "engine/forces/pair_matrix.h"
#include "engine/forces/pair_traversal.h"
#include "engine/state/setup.h"

namespace engine {

/// The pair forces of equation 1, in newtons, from every pair of particles in double precision. All faster code is
/// tested against this function, which is kept simple and never optimized.
/// @param velocities  velocities that damping and friction are computed from, in m/s
void pairForcesReference(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                         std::vector<Vec3>& forces);

/// Energy of the conservative part of the force between particles p and i, in joules.
double pairEnergyReference(const ForceField& field, const Particles& particles, std::size_t p, std::size_t i);

/// The same for two particles of different sets.
double pairEnergyReference(const ForceField& field, const Particles& ofP, std::size_t p, const Particles& ofI,
                           std::size_t i);

/// Sum of the energies of all pairs of particles, in joules.
double pairEnergyReference(const ForceField& field, const Particles& particles);

/// Evaluates forces, and keeps the neighbor list and all memory from one evaluation to the next. Results have the same
/// bits for any number of threads. In all functions `velocities` (m/s) are those that damping and friction are computed
/// from, and `step` is the time (s) until the next evaluation, from which the skin of a new neighbor list is chosen; 0
/// if unknown.
class ForceEvaluator {
 public:
    ForceEvaluator() = default;
    ForceEvaluator(ForceField field, ForceMethod method, Precision precision = Precision::doubles,
                   const Ranks& ranks = Ranks::alone());

    /// The pair forces of equation 1 alone, N. The paper's stepper adds weight and obstacle forces to them
    /// (external_forces.h).
    void evaluatePairs(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                       double step = 0.0);

    /// Pair forces and weight (N) without the forces of obstacles, for steppers that sweep contacts. Returns the pair
    /// energy, J.
    double evaluateFree(const Particles& particles, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces,
                        double step = 0.0);

    /// Pair forces and weight (N) at the particles' own velocities, and the matrix of the implicit steppers, whose rows
    /// are in the order of order(). Returns the pair energy, J.
    double assemble(const Particles& particles, const MatrixWeights& weights, std::vector<Vec3>& forces,
                    PairMatrix& matrix, double step = 0.0);

    /// The indices of all particles in the order of the neighbor list, which is also the order of the matrix that was
    /// assembled last. With many ranks it has ghosts, too, with kGhost instead of an index.
    const std::vector<std::uint32_t>& order() const { return pairs_.order(); }

    /// The neighbor list as it was last built.
    const NeighborList& list() const { return pairs_.list; }

    /// Whether forces are summed over the neighbor list; the reference needs none.
    bool needsList() const { return method_ == ForceMethod::grid; }

    /// Brings the neighbor list up to date, and the positions of ghosts, if the method needs a list.
    void renewList(const Particles& particles);

    /// Brings the positions of ghosts up to date. Only needed where nothing else does.
    void fetchGhosts(const Particles& particles);

    /// Discards the neighbor list. To be called when particles have got other indices.
    void forgetList();

    /// Rebuilds the neighbor list of a resumed run.
    /// @param builtAt  positions that the list was built for, m, of the first particles
    /// @param cutoff   cutoff that it was built for, m
    /// @param skin     its skin, m
    void restoreList(const Particles& particles, const std::vector<Vec3>& builtAt, double cutoff, double skin);

    /// Groups of particles each of which may move as a whole without outdating the neighbor list; none at first.
    const FarGroups& groups() const { return pairs_.groups; }
    void setGroups(FarGroups groups) { pairs_.groups = std::move(groups); }

    /// Whether no listed neighbor of particle p is so near that it acts on p. If the neighbor list covers the
    /// particles' positions, then no other particle acts on p either. False for a particle that was emitted after the
    /// list was built and has no listed neighbors.
    /// @param positions       of the particles, m; with many ranks, those for which ghosts were fetched are used
    /// instead
    /// @param radii           of the particles, m
    /// @param cachedNeighbor  index of the particle that is tried first; set to the neighbor that was found. Any value
    ///                        is valid on entry, and the answer does not depend on it.
    bool hasNoNeighbor(const std::vector<Vec3>& positions, const std::vector<double>& radii, std::size_t p,
                       std::uint32_t& cachedNeighbor) const;

    /// Sum of the energies of the pairs in the neighbor list (conservative part of the force), in joules.
    double pairEnergyGrid(const Particles& particles);

    /// The pairs of the particles as they are, for passes over neighbors that compute something else than forces. In
    /// double precision.
    const PairTraversal& preparePairs(const Particles& particles);

    /// Brings a number of each particle, and those of ghosts from their ranks, into the combined order of
    /// PairTraversal's lists, which is that of the particles in a run in one process. After preparePairs().
    void shareNumbers(const std::vector<double>& own, std::vector<double>& combined) const;
    void shareMaterials(const std::vector<std::uint32_t>& own, std::vector<std::uint32_t>& combined) const;

    /// Tells the ghosts' ranks that particles have got other materials.
    void renewMaterials(const Particles& particles);

    const ForceField& forceField() const { return field_; }

 private:
    void addGravity(const Particles& particles, std::vector<Vec3>& forces) const;

    ForceField field_;
    double cutoffRatio_ = 0.0;  ///< largest cutoff of a pair, in sums of its radii
    ForceMethod method_ = ForceMethod::grid;
    PairTraversal pairs_;
};

}  // namespace engine
