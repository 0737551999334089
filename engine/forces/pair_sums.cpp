// Sums equation 1 over the neighbor list. The kernel that runs is compiled with only the terms that the materials need
// and the sums that the caller wants. A SIMD kernel serves nearly all sets of particles; a scalar kernel serves
// particles of too many materials, and pairs that coincide.
#include "engine/forces/pair_sums.h"

#include <algorithm>
#include <cmath>

#include "engine/forces/simd_forces.h"
#include "engine/ranks/exact_sums.h"

namespace engine {
namespace {

/// Sums over the pairs of one particle.
struct ParticleSums {
    Vec3 force = Vec3::Zero();  ///< N
    double energy = 0.0;        ///< half of the energies of the particle's pairs, J
};

/// Two particles p and i within the cutoff, with their separation P and its square P.P as PairTraversal::visitPair()
/// computes them.
struct Pair {
    const PackedParticle& p;
    const PackedParticle& i;
    const Vec3& separation;
    double distanceSq;

    Vec3 velocity() const { return {p.vx - i.vx, p.vy - i.vy, p.vz - i.vz}; }
};

/// Friction of a pair of particles: the friction force is -damping times the slip velocity.
struct Slip {
    Vec3 velocity = Vec3::Zero();  ///< slip velocity V_t, m/s
    double damping = 0.0;          ///< friction coefficient c_t, kg/s
};

/// Friction of a pair. Forced inline, so that terms shared with the conservative force are computed once.
[[gnu::always_inline]] inline Slip slipOf(const Pair& pair, const PairConstants<double>& constants) {
    const double coefficient = pairCoefficient<kConservative>(pair.distanceSq, 0.0, constants);
    if (!(coefficient > 0.0)) return {};
    const Vec3 velocity = pair.velocity();
    const Vec3 slip = velocity - dot(velocity, pair.separation) / pair.distanceSq * pair.separation;
    return {slip, slipDamping(constants.friction, coefficient * std::sqrt(pair.distanceSq), squaredLength(slip))};
}

/// Energy of a pair of particles at a distance D (m), in joules. A coincident pair is separated by the force at a small
/// stand-in distance, and the work of this force is not contained in U(0). The energy of such a pair is therefore taken
/// as far above U(0) as the energy at the stand-in distance is below U(0).
[[gnu::always_inline]] inline double energyOf(const PackedParticle& p, const PackedParticle& i, double distance,
                                              const PairConstants<double>& constants) {
    const double energy = pairEnergy(distance, constants);
    if (!coincide(p, i)) return energy;
    return 2.0 * pairEnergy(0.0, constants) - energy;
}

/// Adds the force and energy of a pair to the sums of particle p; returns the friction coefficient c_t of the pair, in
/// kg/s.
template <Variant variant>
[[gnu::always_inline]] inline double addPair(const Pair& pair, const PairConstants<double>& constants,
                                             ParticleSums& sums) {
    const double distanceSq = pair.distanceSq;
    const double reachSq =
        variant.terms.cohesion ? std::max(constants.reachSq, constants.pullReachSq) : constants.reachSq;
    double approach = 0.0;
    if constexpr (variant.terms.damping) approach = dot(pair.velocity(), pair.separation);
    sums.force += pairCoefficient<variant.terms>(distanceSq, approach, constants) * pair.separation;
    Slip slip;
    if constexpr (variant.terms.friction) {
        slip = slipOf(pair, constants);
        sums.force -= slip.damping * slip.velocity;
    }
    if constexpr (variant.hasEnergy)
        if (distanceSq < reachSq) sums.energy += 0.5 * energyOf(pair.p, pair.i, std::sqrt(distanceSq), constants);
    return slip.damping;
}

/// Adds the entry of a pair to the matrix of the implicit steppers. The damping b_d s_d and the stiffness max(k, 0) act
/// along the line between the particles, friction across it; each is multiplied by its weight.
template <PairTerms terms>
void addEntry(const Pair& pair, double slipDamping, const PairConstants<double>& constants, const PairSums& wanted,
              std::size_t laneSlot, std::uint32_t other) {
    const MatrixWeights& weights = wanted.weights;
    const double distanceSq = pair.distanceSq;
    double along = 0.0;
    if constexpr (terms.damping) along = weights.damping * pairDampingOverSq(distanceSq, constants);
    if (weights.stiffness > 0.0 && distanceSq < std::max(constants.reachSq, constants.pullReachSq))
        along += weights.stiffness * std::max(0.0, pairStiffness(std::sqrt(distanceSq), constants)) / distanceSq;
    const double across = weights.damping * slipDamping;
    if ((along == 0.0 && across == 0.0) || coincide(pair.p, pair.i)) return;
    // across (1 - n n^T) = across 1 - (across / D^2) P P^T
    wanted.matrix->add(laneSlot, other, along - across / distanceSq, across);
}

/// The scalar kernel: sums over the neighbors of the particle in a lane slot of the neighbor list.
template <Variant variant>
ParticleSums sumParticle(const PairTraversal& pairs, const PairSums& wanted, std::size_t laneSlot) {
    const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
    ParticleSums sums;
    pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
        const Pair pair{p, pairs.packed[other], separation, distanceSq};
        const auto constants = pairs.constants(p, pair.i);
        const double slipDamping = addPair<variant>(pair, constants, sums);
        if constexpr (variant.hasMatrix) addEntry<variant.terms>(pair, slipDamping, constants, wanted, laneSlot, other);
    });
    return sums;
}

/// Calls sumCluster(first, end, energies) for every cluster of particles, given by the range of its lane slots, which
/// number the rows of the neighbor list. The clusters are divided among the threads. sumCluster stores the energies (J)
/// of the lane slots from `first` on if energies are wanted. Returns their sum, or 0 if none are wanted.
template <class SumCluster>
double overClusters(const PairTraversal& pairs, bool hasEnergy, const SumCluster& sumCluster) {
    const std::size_t count = pairs.list.count();
    std::vector<double> energies(hasEnergy ? count : 0);
    constexpr std::size_t kGrain = 4;  // fewest clusters a thread; chosen: a particle takes up to 0.5 microseconds
    inParallel(pairs.list.rows.clusterCount(), kGrain, [&](std::size_t cluster) {
        const std::size_t first = cluster * kClusterSize;
        sumCluster(first, std::min(first + kClusterSize, count), hasEnergy ? &energies[first] : nullptr);
    });
    return hasEnergy ? exactSum(*pairs.ranks, count, [&](std::size_t laneSlot) { return energies[laneSlot]; }) : 0.0;
}

/// Stores the forces (N) on the particles in lane slots, but not on ghosts.
class ForceStore {
 public:
    ForceStore(const PairTraversal& pairs, const PairSums& wanted)
        : pairs_(pairs), order_(pairs.order()), forces_(wanted.forces) {}

    void operator()(std::size_t laneSlot, const Vec3& force) const {
        const std::uint32_t p = order_[pairs_.sortedIndexAt(laneSlot)];
        if (p != kGhost) forces_[p] = force;
    }

 private:
    const PairTraversal& pairs_;
    const std::vector<std::uint32_t>& order_;
    std::vector<Vec3>& forces_;
};

/// Sums over all pairs with the scalar kernel; returns the pair energy, in joules.
template <Variant variant>
double sumOneByOne(const PairTraversal& pairs, const PairSums& wanted) {
    const ForceStore storeForce(pairs, wanted);
    return overClusters(pairs, variant.hasEnergy, [&](std::size_t first, std::size_t end, double* energies) {
        for (std::size_t laneSlot = first; laneSlot < end; ++laneSlot) {
            const ParticleSums sums = sumParticle<variant>(pairs, wanted, laneSlot);
            storeForce(laneSlot, sums.force);
            if constexpr (variant.hasEnergy) energies[laneSlot - first] = sums.energy;
        }
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

/// Adds to a particle's sums the force and energy of the neighbors at the same position, in float. The SIMD kernel has
/// not separated these pairs: it has added no force, and an energy U(0) for each.
template <PairTerms terms>
void addCoincidentFloat(const PairTraversal& pairs, std::size_t laneSlot, ParticleSums& all) {
    // A packed particle moved to the origin, since its position does not matter where P is zero.
    const auto atOrigin = [&](std::uint32_t sortedIndex) {
        const PackedParticleFloat& from = pairs.packedFloat.particles[sortedIndex];
        return PackedParticle{.x = 0.0,
                              .y = 0.0,
                              .z = 0.0,
                              .vx = from.vx,
                              .vy = from.vy,
                              .vz = from.vz,
                              .radius = from.radius,
                              .material = from.material,
                              .id = pairs.packedFloat.id(sortedIndex)};
    };
    const std::uint32_t own = pairs.sortedIndexAt(laneSlot);
    const NeighborRows& rows = pairs.list.rows;
    ParticleSums sums;
    for (std::uint32_t k = 0; k < rows.length[laneSlot]; ++k) {
        const std::uint32_t other = rows.sortedIndexAt(laneSlot, k);
        if (!pairs.packedFloat.coincide(own, other)) continue;
        const PackedParticle p = atOrigin(own);
        const PackedParticle i = atOrigin(other);
        const PairConstants<double> constants = pairs.constants(p, i);
        PairTraversal::visitPair(p, i, [&](const Vec3& separation, double distanceSq) {
            addPair<Variant{terms, true, false}>({p, i, separation, distanceSq}, constants, sums);
        });
        sums.energy -= 0.5 * pairEnergy(0.0, constants);
    }
    all.force += sums.force;
    all.energy += sums.energy;
}

/// Corrects the sums of those particles of a cluster that share their position with a neighbor, because the SIMD kernel
/// cannot separate such pairs. In double precision the scalar kernel computes these sums anew. The rows of the matrix
/// stay as the SIMD kernel has written them; otherwise the two entries of a pair would be rounded differently.
template <PairTerms terms>
void correctCoincident(const PairTraversal& pairs, const PairSums& wanted, std::size_t first, ClusterSums& sums) {
    for (std::size_t lane = 0; lane < kClusterSize; ++lane) {
        if ((sums.coincident >> lane & 1U) == 0) continue;
        ParticleSums own{Vec3(sums.x[lane], sums.y[lane], sums.z[lane]), sums.energy[lane]};
        if (!pairs.packedFloat.empty())
            addCoincidentFloat<terms>(pairs, first + lane, own);
        else if (isCoincident(pairs, first + lane))
            own = sumParticle<Variant{terms, true, false}>(pairs, wanted, first + lane);
        sums.x[lane] = own.force.x();
        sums.y[lane] = own.force.y();
        sums.z[lane] = own.force.z();
        sums.energy[lane] = own.energy;
    }
}

/// Sums over all pairs with a SIMD kernel; returns the pair energy, in joules.
double sumInLanes(const PairTraversal& pairs, const PairSums& wanted) {
    const bool hasEnergy = wanted.energy != nullptr || wanted.matrix != nullptr;
    const ClusterKernel sumCluster = clusterKernel(pairs, wanted);
    const ForceStore storeForce(pairs, wanted);
    return overClusters(pairs, hasEnergy, [&](std::size_t first, std::size_t end, double* energies) {
        ClusterSums sums;
        sumCluster(pairs, wanted, first / kClusterSize, sums);
        if (sums.coincident != 0)
            withTerms(pairs.terms.pair,
                      [&]<PairTerms terms>() { correctCoincident<terms>(pairs, wanted, first, sums); });
        for (std::size_t lane = 0; lane < end - first; ++lane)
            storeForce(first + lane, Vec3(sums.x[lane], sums.y[lane], sums.z[lane]));
        if (hasEnergy) std::copy_n(sums.energy.data(), end - first, energies);
    });
}

}  // namespace

void sumPairs(const PairTraversal& pairs, const PairSums& wanted) {
    if (wanted.matrix != nullptr) {
        makeRoom(*wanted.matrix, pairs.list, pairs.terms.pair.friction);
        wanted.matrix->packed = pairs.packed;
    }
    const double energy =
        pairs.hasLanes() ? sumInLanes(pairs, wanted) : withVariant(pairs.terms.pair, wanted, [&]<Variant variant>() {
            return sumOneByOne<variant>(pairs, wanted);
        });
    if (wanted.matrix != nullptr) padRows(*wanted.matrix);
    if (wanted.energy != nullptr) *wanted.energy = energy;
}

double pairEnergySum(const PairTraversal& pairs) {
    return exactSum(*pairs.ranks, pairs.list.count(), [&](std::size_t laneSlot) {
        double energy = 0.0;
        const PackedParticle& p = pairs.packed[pairs.sortedIndexAt(laneSlot)];
        pairs.forEachNeighbor(laneSlot, [&](std::uint32_t other, const Vec3&, double distanceSq) {
            const PackedParticle& i = pairs.packed[other];
            energy += 0.5 * energyOf(p, i, std::sqrt(distanceSq), pairs.constants(p, i));
        });
        return energy;
    });
}

}  // namespace engine
