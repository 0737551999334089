// The force evaluator: pair forces and gravity by the reference or over the neighbor list, and queries of that list.
#include "engine/forces/forces.h"

#include <algorithm>
#include <utility>

#include "engine/forces/pair_sums.h"

namespace engine {

ForceEvaluator::ForceEvaluator(ForceField field, ForceMethod method, Precision precision)
    : field_(std::move(field)), method_(method), pairs_(field_, precision) {}

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
    matrix.mass.resize(particles.count());
    inParallel(particles.count(), kParticleGrain,
               [&](std::size_t sortedIndex) { matrix.mass[sortedIndex] = particles.mass[order()[sortedIndex]]; });
    addGravity(particles, forces);
    return energy;
}

void ForceEvaluator::renewList(const Particles& particles) {
    if (needsList()) pairs_.renewList(field_, particles, particles.velocity);
}

void ForceEvaluator::forgetList() {
    pairs_.list.builtAt.clear();
    pairs_.list.sortedIndexOf.clear();
}

void ForceEvaluator::restoreList(const Particles& particles, const std::vector<Vec3>& builtAt, double cutoff,
                                 double skin) {
    build(pairs_.list, builtAt, std::span(particles.radius).first(builtAt.size()), cutoff, skin);
}

bool ForceEvaluator::hasNoNeighborWithin(const std::vector<Vec3>& positions, double cutoff, std::size_t p,
                                         std::uint32_t& cachedNeighbor) const {
    const NeighborList& list = pairs_.list;
    if (p >= list.sortedIndexOf.size()) return false;
    const std::size_t known = std::min(positions.size(), list.sortedIndexOf.size());
    const auto isNear = [&](std::uint32_t other) {
        return other < known && squaredLength(positions[p] - positions[other]) < cutoff * cutoff;
    };
    if (cachedNeighbor != p && isNear(cachedNeighbor)) return false;
    const std::size_t laneSlot = list.laneSlotOf(p);
    for (std::uint32_t k = 0; k < list.rows.length[laneSlot]; ++k) {
        const std::uint32_t other = list.order[list.rows.sortedIndexAt(laneSlot, k)];
        if (!isNear(other)) continue;
        cachedNeighbor = other;
        return false;
    }
    return true;
}

void ForceEvaluator::addGravity(const Particles& particles, std::vector<Vec3>& forces) const {
    inParallel(particles.count(), kParticleGrain,
               [&](std::size_t p) { forces[p] += particles.mass[p] * field_.gravity; });
}

double ForceEvaluator::pairEnergyGrid(const Particles& particles) {
    if (particles.count() < 2) return 0.0;
    pairs_.prepare(field_, particles, particles.velocity);
    pairs_.packParticles(particles, particles.velocity);
    return pairEnergySum(pairs_);
}

}  // namespace engine
