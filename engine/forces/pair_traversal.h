// One way over all neighboring pairs for everything that sums over them: forces, energies, the implicit steppers'
// matrix, the step bound. Each particle visits its own neighbors in a fixed order and writes to itself alone: no
// thread waits for another, and no sum depends on how the work is shared out.
#pragma once

#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/scratch.h"
#include "engine/forces/force_law.h"
#include "engine/forces/packed_particle.h"
#include "engine/law/pair_law.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/neighbors/neighbor_rows.h"
#include "engine/state/setup.h"

namespace engine {

/// Particles sorted for visiting, their neighbors, and the constants of their pairs. Kept between visits: most of them
/// find the list still good.
struct PairTraversal {
    std::vector<Material> pairMaterials;  ///< mixedPairs of the law
    std::size_t materialCount = 0;
    ForceTerms terms;
    PairConstants<double> uniform;  ///< of every pair, where the terms are uniform
    double uniformRadius = 0.0;     ///< of every particle there, m
    NeighborList list;
    Precision precision = Precision::doubles;                ///< of forces where the terms are uniform
    Scratch<std::vector<PackedParticle>> packed;             ///< in the list's order, where there are any
    Scratch<std::vector<PackedParticleFloat>> packedFloats;  ///< in the list's order; empty in double
    double unit = 0.0;                                       ///< of the packedFloats' positions, m
    bool arePacked = false;                                  ///< not in float, unless they are asked for

    PairTraversal() = default;
    PairTraversal(const ForceLaw& law, Precision precision);

    /// Sorts the particles, with the velocities (m/s) that the damping is to see, and brings the list up to date. A new
    /// one is made for passes that are a step (s) apart; 0: nobody knows.
    void prepare(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                 double step = 0.0);

    /// The first block of it: brings the list up to date, but makes no packed.
    void renewList(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                   double step = 0.0);

    /// Particles have other indices now: the list serves nobody any more.
    void forgetList();

    /// After prepare(), for the same: the packed, where there are none yet, for whatever float is not enough for.
    void packParticles(const Particles& particles, const std::vector<Vec3>& velocities);

    /// Brings back the list that was built for these positions (m) with this reach (m).
    void restoreList(const std::vector<Vec3>& builtAt, double reach) { build(list, builtAt, reach, 0.0); }

    template <bool isUniform>
    PairConstants<double> constants(const PackedParticle& p, const PackedParticle& i) const {
        if constexpr (isUniform) return uniform;
        return pairConstants<double>(pairMaterials[p.material * materialCount + i.material], p.radius + i.radius);
    }

    /// Place of the particle in a laneSlot of the list.
    std::uint32_t sortedIndexAt(std::size_t laneSlot) const {
        return static_cast<std::uint32_t>(list.rows.ownIndices[laneSlot]);
    }

    /// Calls visit(other sortedIndex, P, P.P) for every other particle within the cutoff of the one in a laneSlot of
    /// the list. A list's row holds some beyond the cutoff, unpredictably so: they are sifted without branches first.
    template <class Visit>
    void forEachNeighbor(std::size_t laneSlot, const Visit& visit) const {
        const PackedParticle& p = packed[sortedIndexAt(laneSlot)];
        const double cutoffSq = terms.cutoff * terms.cutoff;
        constexpr std::uint32_t kSieve = 128;  // chosen: longer than most rows
        std::array<std::uint32_t, kSieve> within;
        const RowBlock& block = list.rows.blocks[NeighborRows::blockOf(laneSlot)];
        const std::size_t first = list.rows.at(laneSlot, 0);
        const std::uint32_t length = list.rows.length[laneSlot];
        for (std::uint32_t begin = 0; begin < length; begin += kSieve) {
            const std::uint32_t end = std::min(begin + kSieve, length);
            std::size_t found = 0;
            for (std::uint32_t k = begin; k < end; ++k) {
                const auto other = static_cast<std::uint32_t>(block.entries[first + k * kClusterSize]);
                within[found] = other;
                found += squaredLength(separationOf(p, packed[other])) < cutoffSq ? 1U : 0U;
            }
            for (std::size_t k = 0; k < found; ++k) {
                const auto visitIt = [&](const Vec3& separation, double distanceSq) {
                    visit(within[k], separation, distanceSq);
                };
                visitPair(p, packed[within[k]], visitIt);
            }
        }
    }

    /// Calls visit(P, P.P) for a pair; one that coincides has a stand-in for P.
    template <class Visit>
    static void visitPair(const PackedParticle& p, const PackedParticle& i, const Visit& visit) {
        Vec3 separation = separationOf(p, i);
        double distanceSq = squaredLength(separation);
        if (distanceSq == 0.0) {
            const auto [x, y, z] = coincidentSeparation(p.id, i.id, p.radius + i.radius);
            separation = Vec3(x, y, z);
            distanceSq = squaredLength(separation);
        }
        visit(separation, distanceSq);
    }

    /// Calls body(laneSlot in the list) for every particle, shared out over the threads.
    template <class Body>
    void forEachParticle(const Body& body) const {
        constexpr std::size_t kGrain = 64;  // chosen: particles of a dense scene take half a microsecond each
        inParallel(list.count(), kGrain, body);
    }

 private:
    static Vec3 separationOf(const PackedParticle& p, const PackedParticle& i) {
        return {p.x - i.x, p.y - i.y, p.z - i.z};
    }
};

}  // namespace engine
