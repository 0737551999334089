// Equation 1 over the neighbour list, with only the terms that the materials need and the sums that the caller wants
// compiled into the kernel that runs.
#include "engine/pair_sums.h"

#include <algorithm>
#include <cmath>

#include "engine/lane_forces.h"

namespace engine {
namespace {

/// What a kernel is compiled for.
struct Variant {
    PairTerms terms;
    bool uniform = true;
    bool energy = false;
    bool matrix = false;
};

/// Friction of a pair.
struct Slip {
    Vec3 velocity = Vec3::Zero();  ///< V_t, m/s
    double damping = 0.0;          ///< c_t, kg/s
};

/// Inline, so that what the pair's coefficient has in common with it is computed once.
[[gnu::always_inline]] inline Slip slipOf(const PairRecord& p, const PairRecord& i, const Vec3& separation,
                                          double distanceSq, const PairConstants<double>& constants) {
    const double coefficient = pairCoefficient<PairTerms{true, false}>(distanceSq, 0.0, constants);
    if (!(coefficient > 0.0)) return {};
    const Vec3 velocity(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz);
    Slip slip;
    slip.velocity = velocity - dot(velocity, separation) / distanceSq * separation;
    slip.damping = slipDamping(constants.friction, coefficient * std::sqrt(distanceSq), squaredLength(slip.velocity));
    return slip;
}

/// A coincident pair is parted by a force that its energy at D = 0 does not know: it counts as much above that energy
/// as its stand-in lies below.
[[gnu::always_inline]] inline double energyOf(const PairRecord& p, const PairRecord& i, double distance,
                                              const PairConstants<double>& constants) {
    const double energy = pairEnergy(distance, constants);
    if (p.x != i.x || p.y != i.y || p.z != i.z) return energy;
    return 2.0 * pairEnergy(0.0, constants) - energy;
}

/// The pass over one particle's neighbours.
template <Variant variant>
struct Kernel {
    const PairTraversal& pairs;
    const PairSums& sums;
    std::vector<double>& energies;  ///< half of the energy of every pair of a particle, J

    void operator()(std::uint32_t self) const {
        const PairRecord& p = pairs.records[self];
        Vec3 force = Vec3::Zero();
        double energy = 0.0;
        pairs.forEachNeighbour(self, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
            const PairRecord& i = pairs.records[other];
            const auto constants = pairs.constants<variant.uniform>(p, i);
            double approach = 0.0;
            if constexpr (variant.terms.damping)
                approach = dot(Vec3(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz), separation);
            force += pairCoefficient<variant.terms>(distanceSq, approach, constants) * separation;
            Slip slip;
            if constexpr (variant.terms.friction) {
                slip = slipOf(p, i, separation, distanceSq, constants);
                force -= slip.damping * slip.velocity;
            }
            if constexpr (variant.energy)
                if (distanceSq < constants.reachSq) energy += 0.5 * energyOf(p, i, std::sqrt(distanceSq), constants);
            if constexpr (variant.matrix) addEntry(self, other, distanceSq, slip.damping, constants);
        });
        sums.forces[pairs.list.order[self]] = force;
        if constexpr (variant.energy) energies[self] = energy;
    }

    /// Across the pair acts friction, along it the damping b_d s_d and the stiffness max(k, 0), each times its weight.
    void addEntry(std::uint32_t self, std::uint32_t other, double distanceSq, double slipDamping,
                  const PairConstants<double>& constants) const {
        double along = 0.0;
        if constexpr (variant.terms.damping) along = sums.weights.damping * pairDampingOverSq(distanceSq, constants);
        if (sums.weights.stiffness > 0.0 && distanceSq < constants.reachSq) {
            const double stiffness = pairStiffness(std::sqrt(distanceSq), constants);
            along += sums.weights.stiffness * std::max(0.0, stiffness) / distanceSq;
        }
        const double across = sums.weights.damping * slipDamping;
        const PairRecord& p = pairs.records[self];
        const PairRecord& i = pairs.records[other];
        const bool isCoincident = p.x == i.x && p.y == i.y && p.z == i.z;
        if ((along == 0.0 && across == 0.0) || isCoincident) return;
        // across (1 - n n^T) = across 1 - (across / D^2) P P^T
        sums.matrix->add(self, static_cast<std::int32_t>(other), along - across / distanceSq, across);
    }
};

template <Variant variant>
void run(const PairTraversal& pairs, const PairSums& sums, std::vector<double>& energies) {
    pairs.forEachParticle(Kernel<variant>{pairs, sums, energies});
}

/// Forces and energies by the scalar kernel, which knows how to part coincident particles. The rows of the matrix stay
/// those of the lanes, or the two entries of a pair would be rounded differently.
template <PairTerms terms>
void addUpOneByOne(const PairTraversal& pairs, const PairSums& sums, std::vector<double>& energies, std::size_t first,
                   std::size_t end) {
    for (std::size_t place = first; place < end; ++place) {
        const auto self = static_cast<std::uint32_t>(place);
        if (energies.empty())
            Kernel<Variant{terms, true, false, false}>{pairs, sums, energies}(self);
        else
            Kernel<Variant{terms, true, true, false}>{pairs, sums, energies}(self);
    }
}

/// What is wanted of uniform particles, a particle a lane. Groups with coincident particles are done again.
template <PairTerms terms>
void addUpGroups(const PairTraversal& pairs, const PairSums& sums, std::vector<double>& energies) {
    const bool hasEnergy = sums.energy != nullptr || sums.matrix != nullptr;
    const LanePass pass{pairs.lanes, pairs.records, pairs.singles, pairs.unit,  pairs.uniform,
                        terms,       hasEnergy,     sums.matrix,   sums.weights};
    constexpr std::size_t kGrain = 4;  // chosen: as kGrain of forEachParticle, in groups
    inParallel(pairs.lanes.groupCount(), kGrain, [&](std::size_t group) {
        LaneSums of;
        addUpGroup(pass, group, of);
        const std::size_t first = group * kGroup;
        const std::size_t end = std::min(first + kGroup, pairs.records.size());
        if (of.coincident) return addUpOneByOne<terms>(pairs, sums, energies, first, end);
        for (std::size_t place = first; place < end; ++place) {
            const std::size_t lane = place - first;
            sums.forces[pairs.list.order[place]] = Vec3(of.x[lane], of.y[lane], of.z[lane]);
            if (hasEnergy) energies[place] = of.energy[lane];
        }
    });
}

using Pass = void (*)(const PairTraversal&, const PairSums&, std::vector<double>&);

template <PairTerms terms, bool isUniform>
Pass passFor(const PairSums& sums) {
    if constexpr (isUniform) return addUpGroups<terms>;
    if (sums.matrix != nullptr) return run<Variant{terms, isUniform, true, true}>;
    return sums.energy != nullptr ? run<Variant{terms, isUniform, true, false}>
                                  : run<Variant{terms, isUniform, false, false}>;
}

template <bool isUniform>
Pass passFor(PairTerms terms, const PairSums& sums) {
    // Friction is for few scenes: it shares one kernel that has everything.
    if (terms.friction) return passFor<PairTerms{true, true, true}, isUniform>(sums);
    if (terms.attraction)
        return terms.damping ? passFor<PairTerms{true, true}, isUniform>(sums)
                             : passFor<PairTerms{true, false}, isUniform>(sums);
    return terms.damping ? passFor<PairTerms{false, true}, isUniform>(sums)
                         : passFor<PairTerms{false, false}, isUniform>(sums);
}

/// In order: the order of the sum is part of the result.
double total(const std::vector<double>& energies) {
    double sum = 0.0;
    for (const double energy : energies) sum += energy;
    return sum;
}

}  // namespace

void addUpPairs(const PairTraversal& pairs, const PairSums& sums) {
    if (sums.matrix != nullptr) {
        makeRoom(*sums.matrix, pairs.list, pairs.terms.pair.friction);
        sums.matrix->records = pairs.records;
    }
    std::vector<double> energies(sums.energy != nullptr || sums.matrix != nullptr ? pairs.records.size() : 0);
    const PairTerms terms = pairs.terms.pair;
    (pairs.terms.uniform ? passFor<true>(terms, sums) : passFor<false>(terms, sums))(pairs, sums, energies);
    if (sums.matrix != nullptr) close(*sums.matrix);
    if (sums.energy != nullptr) *sums.energy = total(energies);
}

double pairEnergySum(const PairTraversal& pairs) {
    std::vector<double> energies(pairs.records.size());
    pairs.forEachParticle([&](std::uint32_t self) {
        double energy = 0.0;
        pairs.forEachNeighbour(self, [&](std::uint32_t other, const Vec3&, double distanceSq) {
            const auto constants = pairs.constants<false>(pairs.records[self], pairs.records[other]);
            energy += 0.5 * pairEnergy(std::sqrt(distanceSq), constants);
        });
        energies[self] = energy;
    });
    return total(energies);
}

}  // namespace engine
