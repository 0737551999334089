// Equation 1 over the neighbour list, with only the terms that the materials need and the sums that the caller wants
// compiled into the kernel that runs.
#include "engine/pair_sums.h"

#include <algorithm>
#include <atomic>
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

/// The pass over one particle's neighbours; gives half of the energy of its pairs, J.
template <Variant variant>
struct Kernel {
    const PairTraversal& pairs;
    const PairSums& sums;

    double operator()(std::size_t seat) const {
        const std::uint32_t self = pairs.placeAt(seat);
        const PairRecord& p = pairs.records[self];
        Vec3 force = Vec3::Zero();
        double energy = 0.0;
        pairs.forEachNeighbour(seat, [&](std::uint32_t other, const Vec3& separation, double distanceSq) {
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
            if constexpr (variant.matrix) addEntry(seat, other, distanceSq, slip.damping, constants);
        });
        sums.forces[pairs.list.order[self]] = force;
        return energy;
    }

    /// Across the pair acts friction, along it the damping b_d s_d and the stiffness max(k, 0), each times its weight.
    void addEntry(std::size_t seat, std::uint32_t other, double distanceSq, double slipDamping,
                  const PairConstants<double>& constants) const {
        double along = 0.0;
        if constexpr (variant.terms.damping) along = sums.weights.damping * pairDampingOverSq(distanceSq, constants);
        if (sums.weights.stiffness > 0.0 && distanceSq < constants.reachSq) {
            const double stiffness = pairStiffness(std::sqrt(distanceSq), constants);
            along += sums.weights.stiffness * std::max(0.0, stiffness) / distanceSq;
        }
        const double across = sums.weights.damping * slipDamping;
        const PairRecord& p = pairs.records[pairs.placeAt(seat)];
        const PairRecord& i = pairs.records[other];
        const bool isCoincident = p.x == i.x && p.y == i.y && p.z == i.z;
        if ((along == 0.0 && across == 0.0) || isCoincident) return;
        // across (1 - n n^T) = across 1 - (across / D^2) P P^T
        sums.matrix->add(seat, static_cast<std::int32_t>(other), along - across / distanceSq, across);
    }
};

/// The seats of a group.
struct Group {
    std::size_t first, end;
};

/// Calls body for every group of seats, shared out over the threads, and returns the sum of what it gives, J.
template <class Body>
double overGroups(std::size_t count, const Body& body) {
    std::vector<double> energies((count + kGroup - 1) / kGroup);
    constexpr std::size_t kGrain = 4;  // chosen: particles of a dense scene take up to half a microsecond each
    inParallel(energies.size(), kGrain, [&](std::size_t group) {
        energies[group] = body(Group{group * kGroup, std::min((group + 1) * kGroup, count)});
    });
    return sumOver(energies.size(), [&](std::size_t group) { return energies[group]; });
}

template <class Of>
double sumOf(const Group& group, const Of& of) {
    double sum = 0.0;
    for (std::size_t seat = group.first; seat < group.end; ++seat) sum += of(seat);
    return sum;
}

/// Of a pass: the pair energy, J, and whether lanes met coincident pairs.
struct Outcome {
    double energy = 0.0;
    bool metCoincident = false;
};

template <Variant variant>
Outcome run(const PairTraversal& pairs, const PairSums& sums) {
    const Kernel<variant> kernel{pairs, sums};
    return {.energy = overGroups(pairs.list.count(), [&](const Group& group) { return sumOf(group, kernel); })};
}

/// Whether a particle shares its exact position with a neighbour. In float some that are merely near seem to, but what
/// those do to each other is less than a rounding of what they do in contact.
bool isCoincident(const PairTraversal& pairs, std::size_t seat) {
    const PairRecord& p = pairs.records[pairs.placeAt(seat)];
    const LaneRows& rows = pairs.list.rows;
    for (std::uint32_t k = 0; k < rows.length[seat]; ++k) {
        const PairRecord& i = pairs.records[static_cast<std::size_t>(*rows.entry(seat, k))];
        if (p.x == i.x && p.y == i.y && p.z == i.z) return true;
    }
    return false;
}

/// What is wanted of uniform particles, a particle a lane. Coincident ones are done again by the scalar kernel, which
/// knows how to part them; the rows of the matrix stay those of the lanes, or the two entries of a pair would be
/// rounded differently.
template <PairTerms terms>
Outcome addUpGroups(const PairTraversal& pairs, const PairSums& sums) {
    const bool hasEnergy = sums.energy != nullptr || sums.matrix != nullptr;
    const double unit = pairs.singles.empty() ? 1.0 : pairs.unit;
    const LanePass pass{pairs.list.rows, pairs.records, pairs.singles, unit,        pairs.uniform,
                        terms,           hasEnergy,     sums.matrix,   sums.weights};
    const Kernel<Variant{terms, true, false, false}> forces{pairs, sums};
    const Kernel<Variant{terms, true, true, false}> forcesAndEnergy{pairs, sums};
    std::atomic<bool> metCoincident = false;
    const double energy = overGroups(pairs.list.count(), [&](const Group& group) {
        LaneSums of;
        addUpGroup(pass, group.first / kGroup, of);
        if (of.coincident != 0) metCoincident = true;
        if (of.coincident != 0 && !pairs.hasRecords) return 0.0;
        return sumOf(group, [&](std::size_t seat) {
            const std::size_t lane = seat - group.first;
            if ((of.coincident >> lane & 1U) != 0 && isCoincident(pairs, seat))
                return hasEnergy ? forcesAndEnergy(seat) : forces(seat);
            sums.forces[pairs.list.order[pairs.placeAt(seat)]] = Vec3(of.x[lane], of.y[lane], of.z[lane]);
            return of.energy[lane];
        });
    });
    return {energy, metCoincident};
}

using Pass = Outcome (*)(const PairTraversal&, const PairSums&);

template <PairTerms terms, bool isUniform>
Pass passFor(const PairSums& sums) {
    if constexpr (isUniform) {
        return addUpGroups<terms>;
    } else {
        if (sums.matrix != nullptr) return run<Variant{terms, false, true, true}>;
        return sums.energy != nullptr ? run<Variant{terms, false, true, false}>
                                      : run<Variant{terms, false, false, false}>;
    }
}

template <bool isUniform>
Pass passFor(PairTerms terms, const PairSums& sums) {
    // Friction is for few scenes: it shares one kernel that has everything.
    if (terms.friction) return passFor<PairTerms{true, true, true}, isUniform>(sums);
    if (terms.damping && terms.oneReach) return passFor<PairTerms{true, true, false, true}, isUniform>(sums);
    if (terms.attraction)
        return terms.damping ? passFor<PairTerms{true, true}, isUniform>(sums)
                             : passFor<PairTerms{true, false}, isUniform>(sums);
    return terms.damping ? passFor<PairTerms{false, true}, isUniform>(sums)
                         : passFor<PairTerms{false, false}, isUniform>(sums);
}

}  // namespace

bool addUpPairs(const PairTraversal& pairs, const PairSums& sums) {
    if (sums.matrix != nullptr) {
        makeRoom(*sums.matrix, pairs.list, pairs.terms.pair.friction);
        sums.matrix->records = pairs.records;
    }
    const PairTerms terms = pairs.terms.pair;
    const Pass pass = pairs.terms.uniform ? passFor<true>(terms, sums) : passFor<false>(terms, sums);
    const Outcome outcome = pass(pairs, sums);
    if (sums.matrix != nullptr) close(*sums.matrix);
    if (sums.energy != nullptr) *sums.energy = outcome.energy;
    return outcome.metCoincident;
}

double pairEnergySum(const PairTraversal& pairs) {
    const auto energyOfOne = [&](std::size_t seat) {
        double energy = 0.0;
        const PairRecord& p = pairs.records[pairs.placeAt(seat)];
        pairs.forEachNeighbour(seat, [&](std::uint32_t other, const Vec3&, double distanceSq) {
            const PairRecord& i = pairs.records[other];
            energy += 0.5 * energyOf(p, i, std::sqrt(distanceSq), pairs.constants<false>(p, i));
        });
        return energy;
    };
    return overGroups(pairs.list.count(), [&](const Group& group) { return sumOf(group, energyOfOne); });
}

}  // namespace engine
