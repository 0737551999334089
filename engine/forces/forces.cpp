// The force evaluator: pair forces and gravity by the reference or over the neighbor list, and queries of that list.
#include "engine/forces/forces.h"

#include <algorithm>
#include <utility>

#include "engine/forces/pair_sums.h"

namespace engine {
namespace {

/// Tells the matrix of one of many ranks which of its rows are of ghosts, and how their parts of a vector are fetched.
void addGhosts(const PairTraversal& pairs, PairMatrix& matrix) {
    matrix.ranks = pairs.ranks;
    matrix.ghosts.clear();
    for (std::uint32_t sortedIndex = 0; sortedIndex < pairs.list.count(); ++sortedIndex)
        if (pairs.withGhosts.order[sortedIndex] == kGhost) matrix.ghosts.push_back(sortedIndex);
    matrix.fetchGhosts = [&pairs, own = std::vector<Vec3>(), all = std::vector<Vec3>()](std::vector<Vec3>& x) mutable {
        const NeighborList& list = pairs.list;
        own.resize(pairs.withGhosts.halo.combinedIndexOf.size());
        for (std::size_t sortedIndex = 0; sortedIndex < x.size(); ++sortedIndex)
            if (pairs.withGhosts.order[sortedIndex] != kGhost)
                own[pairs.withGhosts.order[sortedIndex]] = x[sortedIndex];
        share(*pairs.ranks, pairs.withGhosts.halo, own, all);
        for (std::size_t sortedIndex = 0; sortedIndex < x.size(); ++sortedIndex)
            x[sortedIndex] = all[list.order[sortedIndex]];
    };
}

}  // namespace

ForceEvaluator::ForceEvaluator(ForceField field, ForceMethod method, Precision precision, const Ranks& ranks)
    : field_(std::move(field)),
      cutoffRatio_(cutoffRatio(field_.materials)),
      method_(method),
      pairs_(field_, precision, ranks) {}

void ForceEvaluator::evaluatePairs(const Particles& particles, const std::vector<Vec3>& velocities,
                                   std::vector<Vec3>& forces, double step) {
    if (method_ == ForceMethod::reference) return pairForcesReference(field_, particles, velocities, forces);
    forces.resize(particles.count());
    pairs_.prepare(field_, particles, velocities, step);
    sumPairs(pairs_, {.forces = forces});
}

double ForceEvaluator::evaluateFree(const Particles& particles, const std::vector<Vec3>& velocities,
                                    std::vector<Vec3>& forces, double step) {
    double energy = 0.0;
    if (method_ == ForceMethod::reference) {
        pairForcesReference(field_, particles, velocities, forces);
        energy = pairEnergyReference(field_, particles);
    } else {
        forces.resize(particles.count());
        pairs_.prepare(field_, particles, velocities, step);
        sumPairs(pairs_, {.forces = forces, .energy = &energy});
    }
    addGravity(particles, forces);
    return energy;
}

double ForceEvaluator::assemble(const Particles& particles, const MatrixWeights& weights, std::vector<Vec3>& forces,
                                PairMatrix& matrix, double step) {
    double energy = 0.0;
    forces.resize(particles.count());
    pairs_.prepare(field_, particles, particles.velocity, step);
    pairs_.packParticles(particles, particles.velocity);
    sumPairs(pairs_, {.forces = forces, .energy = &energy, .matrix = &matrix, .weights = weights});
    // Only the forces have a reference. The matrix always comes from the neighbor list, since over every pair of
    // particles its products would be the same sums.
    if (method_ == ForceMethod::reference) pairForcesReference(field_, particles, particles.velocity, forces);
    const Particles& listed = pairs_.listed(particles);
    matrix.mass.resize(pairs_.list.count());
    inParallel(matrix.mass.size(), kParticleGrain, [&](std::size_t sortedIndex) {
        matrix.mass[sortedIndex] = listed.mass[pairs_.list.order[sortedIndex]];
    });
    if (pairs_.ranks->areMany()) addGhosts(pairs_, matrix);
    addGravity(particles, forces);
    return energy;
}

void ForceEvaluator::renewList(const Particles& particles) {
    if (needsList()) pairs_.renewList(field_, particles, particles.velocity);
}

void ForceEvaluator::fetchGhosts(const Particles& particles) {
    if (pairs_.ranks->areMany())
        engine::fetchGhosts(*pairs_.ranks, particles.position, particles.velocity, pairs_.withGhosts);
}

void ForceEvaluator::forgetList() {
    discard(pairs_.list);
}

void ForceEvaluator::restoreList(const Particles& particles, const std::vector<Vec3>& builtAt, double cutoff,
                                 double skin) {
    pairs_.buildList(particles, builtAt, cutoff, skin);
}

bool ForceEvaluator::hasNoNeighbor(const std::vector<Vec3>& positions, const std::vector<double>& radii, std::size_t p,
                                   std::uint32_t& cachedNeighbor) const {
    const NeighborList& list = pairs_.list;
    const bool areMany = pairs_.ranks->areMany();
    const OwnAndGhosts& withGhosts = pairs_.withGhosts;
    if (p >= (areMany ? withGhosts.halo.combinedIndexOf.size() : list.sortedIndexOf.size())) return false;
    const std::vector<Vec3>& at = areMany ? withGhosts.particles.position : positions;
    const std::vector<double>& radius = areMany ? withGhosts.particles.radius : radii;
    const std::size_t self = areMany ? withGhosts.halo.combinedIndexOf[p] : p;
    const std::size_t known = std::min(at.size(), list.sortedIndexOf.size());
    const auto isNear = [&](std::uint32_t other) {
        if (other >= known) return false;
        const double cutoff = cutoffRatio_ * (radius[self] + radius[other]);
        return squaredLength(at[self] - at[other]) < cutoff * cutoff;
    };
    if (cachedNeighbor != self && isNear(cachedNeighbor)) return false;
    const std::size_t laneSlot = list.laneSlotOf(self);
    for (std::uint32_t k = 0; k < list.rows.length[laneSlot]; ++k) {
        const std::uint32_t other = list.order[list.rows.sortedIndexAt(laneSlot, k)];
        if (!isNear(other)) continue;
        cachedNeighbor = other;
        return false;
    }
    return true;
}

const PairTraversal& ForceEvaluator::preparePairs(const Particles& particles) {
    pairs_.prepare(field_, particles, particles.velocity);
    pairs_.packParticles(particles, particles.velocity);
    return pairs_;
}

void ForceEvaluator::shareNumbers(const std::vector<double>& own, std::vector<double>& combined) const {
    if (!pairs_.ranks->areMany())
        combined = own;
    else
        share(*pairs_.ranks, pairs_.withGhosts.halo, own, combined);
}

void ForceEvaluator::shareMaterials(const std::vector<std::uint32_t>& own, std::vector<std::uint32_t>& combined) const {
    if (!pairs_.ranks->areMany())
        combined = own;
    else
        share(*pairs_.ranks, pairs_.withGhosts.halo, own, combined);
}

void ForceEvaluator::renewMaterials(const Particles& particles) {
    if (pairs_.ranks->areMany()) shareMaterials(particles.material, pairs_.withGhosts.particles.material);
}

void ForceEvaluator::addGravity(const Particles& particles, std::vector<Vec3>& forces) const {
    inParallel(particles.count(), kParticleGrain,
               [&](std::size_t p) { forces[p] += particles.mass[p] * field_.gravity; });
}

double ForceEvaluator::pairEnergyGrid(const Particles& particles) {
    return pairEnergySum(preparePairs(particles));
}

}  // namespace engine
