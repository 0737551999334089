// Equation 1 over the cell grid, with only the terms that the materials need compiled into the kernel that runs.
#include "engine/forces_grid.h"

namespace engine {
namespace {

template <PairTerms terms, bool isUniform>
Vec3 forceOn(const PairTraversal& pairs, const Neighbourhood& around, std::uint32_t self) {
    const PairRecord& p = pairs.records[self];
    Vec3 force = Vec3::Zero();
    pairs.forEachNeighbour(around, self, [&](const PairRecord& i, const Vec3& separation, double distanceSq) {
        double approach = 0.0;
        if constexpr (terms.damping) approach = dot(Vec3(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz), separation);
        force += pairCoefficient<terms>(distanceSq, approach, pairs.constants<isUniform>(p, i)) * separation;
    });
    return force;
}

template <PairTerms terms, bool isUniform>
void addUp(const PairTraversal& pairs, std::vector<Vec3>& forces) {
    pairs.forEachParticle([&](const Neighbourhood& around, std::uint32_t self) {
        forces[pairs.grid.order[self]] = forceOn<terms, isUniform>(pairs, around, self);
    });
}

using Kernel = void (*)(const PairTraversal&, std::vector<Vec3>&);

template <bool isUniform>
Kernel kernelFor(PairTerms terms) {
    if (terms.attraction)
        return terms.damping ? addUp<PairTerms{true, true}, isUniform> : addUp<PairTerms{true, false}, isUniform>;
    return terms.damping ? addUp<PairTerms{false, true}, isUniform> : addUp<PairTerms{false, false}, isUniform>;
}

/// Half of the energy of every pair of a particle, J.
double energyOf(const PairTraversal& pairs, const Neighbourhood& around, std::uint32_t self) {
    double energy = 0.0;
    pairs.forEachNeighbour(around, self, [&](const PairRecord& i, const Vec3&, double distanceSq) {
        energy += 0.5 * pairEnergy(std::sqrt(distanceSq), pairs.constants<false>(pairs.records[self], i));
    });
    return energy;
}

}  // namespace

void pairForces(const PairTraversal& pairs, std::vector<Vec3>& forces) {
    const PairTerms terms = pairs.terms.pair;
    (pairs.terms.uniform ? kernelFor<true>(terms) : kernelFor<false>(terms))(pairs, forces);
}

double pairEnergySum(const PairTraversal& pairs) {
    std::vector<double> energies(pairs.records.size());
    pairs.forEachParticle(
        [&](const Neighbourhood& around, std::uint32_t self) { energies[self] = energyOf(pairs, around, self); });
    double sum = 0.0;  // serial: the order of the sum is part of the result
    for (const double energy : energies) sum += energy;
    return sum;
}

}  // namespace engine
