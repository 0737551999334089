// Equation 1 over the neighbor list, with only the terms that the materials need and the sums that the caller wants
// compiled into the kernel that runs.
#include "engine/forces/pair_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/forces/simd_forces.h"

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
[[gnu::always_inline]] inline Slip slipOf(const PackedParticle& p, const PackedParticle& i, const Vec3& separation,
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
[[gnu::always_inline]] inline double energyOf(const PackedParticle& p, const PackedParticle& i, double distance,
                                              const PairConstants<double>& constants) {
    const double energy = pairEnergy(distance, constants);
    if (!coincide(p, i)) return energy;
    return 2.0 * pairEnergy(0.0, constants) - energy;
}

/// Of a particle.
struct Sums {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< half of its pairs', J
};

Sums operator+(const Sums& a, const Sums& b) {
    return {a.force + b.force, a.energy + b.energy};
}

/// Two particles that act on each other. Shape: as visitPair() has it.
struct Pair {
    const PackedParticle& p;
    const PackedParticle& i;
    const Vec3& separation;
    double distanceSq;
};

/// Adds what a pair does to p; returns its slip damping, kg/s.
template <Variant variant>
[[gnu::always_inline]] inline double addPair(const Pair& pair, const PairConstants<double>& constants, Sums& sums) {
    const auto& [p, i, separation, distanceSq] = pair;
    double approach = 0.0;
    if constexpr (variant.terms.damping) approach = dot(Vec3(p.vx - i.vx, p.vy - i.vy, p.vz - i.vz), separation);
    sums.force += pairCoefficient<variant.terms>(distanceSq, approach, constants) * separation;
    Slip slip;
    if constexpr (variant.terms.friction) {
        slip = slipOf(p, i, separation, distanceSq, constants);
        sums.force -= slip.damping * slip.velocity;
    }
    if constexpr (variant.energy)
        if (distanceSq < constants.reachSq) sums.energy += 0.5 * energyOf(p, i, std::sqrt(distanceSq), constants);
    return slip.damping;
}

/// The pass over one particle's neighbors.
template <Variant variant>
struct Kernel {
    const PairTraversal& pairs;
    const PairSums& wanted;

    Sums operator()(std::size_t laneSlot) const {
        const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
        Sums sums;
        pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
            const PackedParticle& i = pairs.packed[other];
            const auto constants = pairs.constants<variant.uniform>(p, i);
            const double slipDamping = addPair<variant>({p, i, separation, distanceSq}, constants, sums);
            if constexpr (variant.matrix) addEntry(laneSlot, other, distanceSq, slipDamping, constants);
        });
        return sums;
    }

    /// Across the pair acts friction, along it the damping b_d s_d and the stiffness max(k, 0), each times its weight.
    void addEntry(std::size_t laneSlot, std::uint32_t other, double distanceSq, double slipDamping,
                  const PairConstants<double>& constants) const {
        double along = 0.0;
        if constexpr (variant.terms.damping) along = wanted.weights.damping * pairDampingOverSq(distanceSq, constants);
        if (wanted.weights.stiffness > 0.0 && distanceSq < constants.reachSq) {
            const double stiffness = pairStiffness(std::sqrt(distanceSq), constants);
            along += wanted.weights.stiffness * std::max(0.0, stiffness) / distanceSq;
        }
        const double across = wanted.weights.damping * slipDamping;
        const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
        const PackedParticle& i = pairs.packed[other];
        if ((along == 0.0 && across == 0.0) || coincide(p, i)) return;
        // across (1 - n n^T) = across 1 - (across / D^2) P P^T
        wanted.matrix->add(laneSlot, other, along - across / distanceSq, across);
    }
};

/// Seats of a cluster.
struct Cluster {
    std::size_t first, end;
};

/// Calls addUp(cluster) for every cluster, shared out over the threads; returns the sum of the energies that it
/// returns, J. Where nobody asks for them there is none.
template <class AddUp>
double overClusters(const PairTraversal& pairs, bool hasEnergy, const AddUp& addUp) {
    const std::size_t count = pairs.list.count();
    const std::size_t clusters = (count + kClusterSize - 1) / kClusterSize;
    std::vector<double> energies(hasEnergy ? clusters : 0);
    constexpr std::size_t kGrain = 4;  // chosen: particles of a dense scene take up to half a microsecond each
    inParallel(clusters, kGrain, [&](std::size_t number) {
        const double energy = addUp(Cluster{number * kClusterSize, std::min((number + 1) * kClusterSize, count)});
        if (hasEnergy) energies[number] = energy;
    });
    return sumOver(energies.size(), [&](std::size_t cluster) { return energies[cluster]; });
}

/// The force (N) on the particle in a laneSlot.
Vec3& forceOn(const PairTraversal& pairs, std::size_t laneSlot, const PairSums& wanted) {
    return wanted.forces[pairs.list.order[pairs.sortedIndexAt(laneSlot)]];
}

template <Variant variant>
double run(const PairTraversal& pairs, const PairSums& wanted) {
    const Kernel<variant> kernel{pairs, wanted};
    return overClusters(pairs, variant.energy, [&](const Cluster& cluster) {
        double energy = 0.0;
        for (std::size_t laneSlot = cluster.first; laneSlot < cluster.end; ++laneSlot) {
            const Sums sums = kernel(laneSlot);
            forceOn(pairs, laneSlot, wanted) = sums.force;
            energy += sums.energy;
        }
        return energy;
    });
}

/// Whether a particle shares its position with a neighbor.
bool isCoincident(const PairTraversal& pairs, std::size_t laneSlot) {
    const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
    const NeighborRows& rows = pairs.list.rows;
    for (std::uint32_t k = 0; k < rows.length[laneSlot]; ++k)
        if (coincide(p, pairs.packed[rows.sortedIndexAt(laneSlot, k)])) return true;
    return false;
}

/// In float: what those who share its position do to a particle. Of them lanes know only the energy at D = 0.
template <PairTerms terms>
Sums partingSums(const PairTraversal& pairs, std::size_t laneSlot) {
    // What is left of a record where P is zero.
    const auto record = [&](const PackedParticleFloat& of) {
        return PackedParticle{0.0, 0.0, 0.0, of.vx, of.vy, of.vz, pairs.uniformRadius, 0, of.id};
    };
    const PackedParticleFloat& own = pairs.packedFloats[pairs.sortedIndexAt(laneSlot)];
    const NeighborRows& rows = pairs.list.rows;
    Sums sums;
    for (std::uint32_t k = 0; k < rows.length[laneSlot]; ++k) {
        const PackedParticleFloat& other = pairs.packedFloats[rows.sortedIndexAt(laneSlot, k)];
        if (!coincide(own, other)) continue;
        const PackedParticle p = record(own);
        const PackedParticle i = record(other);
        PairTraversal::visitPair(p, i, [&](const Vec3& separation, double distanceSq) {
            addPair<Variant{terms, true, true, false}>({p, i, separation, distanceSq}, pairs.uniform, sums);
        });
        sums.energy -= 0.5 * pairEnergy(0.0, pairs.uniform);
    }
    return sums;
}

Sums sumsOf(const ClusterSums& of, std::size_t lane) {
    return {Vec3(of.x[lane], of.y[lane], of.z[lane]), of.energy[lane]};
}

void keep(const Sums& sums, std::size_t lane, ClusterSums& of) {
    of.x[lane] = sums.force.x();
    of.y[lane] = sums.force.y();
    of.z[lane] = sums.force.z();
    of.energy[lane] = sums.energy;
}

/// What lanes do not know of coincident particles. In double they are done again by the scalar kernel, which knows how
/// to block them; the rows of the matrix stay those of the lanes, or the two entries of a pair would be rounded
/// differently.
template <PairTerms terms>
void partCoincident(const PairTraversal& pairs, const PairSums& wanted, const Cluster& cluster, ClusterSums& of) {
    const Kernel<Variant{terms, true, true, false}> scalar{pairs, wanted};
    for (std::size_t laneSlot = cluster.first; laneSlot < cluster.end; ++laneSlot) {
        const std::size_t lane = laneSlot - cluster.first;
        if ((of.coincident >> lane & 1U) == 0) continue;
        if (!pairs.packedFloats.empty())
            keep(sumsOf(of, lane) + partingSums<terms>(pairs, laneSlot), lane, of);
        else if (isCoincident(pairs, laneSlot))
            keep(scalar(laneSlot), lane, of);
    }
}

/// What is wanted of uniform particles, a particle a lane.
template <PairTerms terms>
double addUpClusters(const PairTraversal& pairs, const PairSums& wanted) {
    const bool hasEnergy = wanted.energy != nullptr || wanted.matrix != nullptr;
    const bool isSingle = !pairs.packedFloats.empty();
    const SimdPass pass{.rows = pairs.list.rows,
                        .packed = pairs.packed,
                        .packedFloats = pairs.packedFloats,
                        .unit = isSingle ? pairs.unit : 1.0,
                        .constants = pairs.uniform,
                        .terms = terms,
                        .energy = hasEnergy,
                        .matrix = wanted.matrix,
                        .weights = wanted.weights};
    return overClusters(pairs, hasEnergy, [&](const Cluster& cluster) {
        ClusterSums of;
        addUpCluster(pass, cluster.first / kClusterSize, of);
        if (of.coincident != 0) partCoincident<terms>(pairs, wanted, cluster, of);
        for (std::size_t laneSlot = cluster.first; laneSlot < cluster.end; ++laneSlot)
            forceOn(pairs, laneSlot, wanted) = sumsOf(of, laneSlot - cluster.first).force;
        // A sum in order takes a fifth of a pass over few neighbors (`globular bench --filter "forces powder"`).
        const auto* const energies = of.energy.data();
        return hasEnergy ? std::accumulate(energies, energies + (cluster.end - cluster.first), 0.0) : 0.0;
    });
}

using Pass = double (*)(const PairTraversal&, const PairSums&);

template <PairTerms terms, bool isUniform>
Pass passFor(const PairSums& wanted) {
    if constexpr (isUniform) {
        return addUpClusters<terms>;
    } else {
        if (wanted.matrix != nullptr) return run<Variant{terms, false, true, true}>;
        return wanted.energy != nullptr ? run<Variant{terms, false, true, false}>
                                        : run<Variant{terms, false, false, false}>;
    }
}

template <bool isUniform>
Pass passFor(PairTerms terms, const PairSums& wanted) {
    // Friction is for few scenes: it shares one kernel that has everything.
    if (terms.friction) return passFor<PairTerms{true, true, true}, isUniform>(wanted);
    if (terms.damping && terms.oneReach) return passFor<PairTerms{true, true, false, true}, isUniform>(wanted);
    if (terms.attraction)
        return terms.damping ? passFor<PairTerms{true, true}, isUniform>(wanted)
                             : passFor<PairTerms{true, false}, isUniform>(wanted);
    return terms.damping ? passFor<PairTerms{false, true}, isUniform>(wanted)
                         : passFor<PairTerms{false, false}, isUniform>(wanted);
}

}  // namespace

void addUpPairs(const PairTraversal& pairs, const PairSums& wanted) {
    if (wanted.matrix != nullptr) {
        makeRoom(*wanted.matrix, pairs.list, pairs.terms.pair.friction);
        wanted.matrix->packed = pairs.packed;
    }
    const PairTerms terms = pairs.terms.pair;
    const Pass pass = pairs.terms.uniform ? passFor<true>(terms, wanted) : passFor<false>(terms, wanted);
    const double energy = pass(pairs, wanted);
    if (wanted.matrix != nullptr) close(*wanted.matrix);
    if (wanted.energy != nullptr) *wanted.energy = energy;
}

double pairEnergySum(const PairTraversal& pairs) {
    const auto energyOfOne = [&](std::size_t laneSlot) {
        double energy = 0.0;
        const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
        pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3&, double distanceSq) {
            const PackedParticle& i = pairs.packed[other];
            energy += 0.5 * energyOf(p, i, std::sqrt(distanceSq), pairs.constants<false>(p, i));
        });
        return energy;
    };
    return sumOver(pairs.list.count(), energyOfOne);
}

}  // namespace engine
