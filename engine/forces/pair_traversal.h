// The data that every pass over pairs of neighbors reads: the neighbor list, the particles packed in the order of the
// list, and the constants of the pairs. A pass visits the neighbors of each particle in a fixed order and writes only
// to that particle, so that no thread waits for another and no sum depends on how the work is divided. Used by the sums
// of pair_sums.cpp and by stepping/step_bound.cpp.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/scratch.h"
#include "engine/force_law/pair_law.h"
#include "engine/forces/force_field.h"
#include "engine/forces/packed_particles.h"
#include "engine/forces/pair_table.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/neighbors/neighbor_rows.h"
#include "engine/neighbors/own_and_ghosts.h"
#include "engine/ranks/ranks.h"
#include "engine/state/setup.h"

namespace engine {

/// State that is kept from one pass over the pairs to the next, since the neighbor list stays valid for many passes.
struct PairTraversal {
    const Ranks* ranks = &Ranks::alone();  ///< the processes that share the particles
    std::vector<Material> materials;
    ForceTerms terms;
    PairTable table;  ///< constants of the pairs of every two materials
    /// The neighbor list; for one of many ranks, of the own particles and ghosts.
    NeighborList list;
    /// Mean number of neighbors within the cutoff when the list was built; none before the first list with particles.
    std::optional<double> meanNeighbors;
    OwnAndGhosts withGhosts;                   ///< of one of many ranks; empty for a run in one process
    FarGroups groups;                          ///< groups each of which may move as a whole without outdating the list
    Precision precision = Precision::doubles;  ///< precision of the pair forces where hasLanes()
    Scratch<std::vector<PackedParticle>> packed;  ///< particles in double; valid while isPacked
    Scratch<PackedFloats> packedFloat;            ///< particles in float; empty for a pass in double
    double unit = 1.0;                            ///< length unit of the packed coordinates, m
    bool isPacked = false;                        ///< whether `packed` holds the particles of the last prepare()

    PairTraversal() = default;
    PairTraversal(const ForceField& field, Precision precision, const Ranks& ranks = Ranks::alone());

    /// Brings the neighbor list up to date and packs the particles for a pass.
    /// @param velocities  velocities that damping and friction are computed from, in m/s
    /// @param step        time until the next pass, from which the skin of a new list is chosen, in s; 0 if unknown
    void prepare(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                 double step = 0.0);

    /// Builds a new neighbor list where the present one does not cover the particles' positions. Part of prepare().
    void renewList(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                   double step = 0.0);

    /// Builds a neighbor list for the first of some particles at these positions (m). Part of renewList().
    void buildList(const Particles& particles, const std::vector<Vec3>& positions, double cutoff, double skin);

    /// Counts the neighbors of some of the listed particles. Part of buildList(). How many more the rows have is of no
    /// use for a mean, because it depends on how they were searched.
    void countNeighbors(const Particles& particles, const SizeTable& sizes);

    /// Packs the particles in double if prepare(), called before with the same arguments, has packed them in float
    /// only.
    void packParticles(const Particles& particles, const std::vector<Vec3>& velocities);

    /// The particles that the neighbor list is of, and the velocities of these: the rank's own, or those with ghosts.
    const Particles& listed(const Particles& own) const { return ranks->areMany() ? withGhosts.particles : own; }
    const std::vector<Vec3>& listedVelocities(const std::vector<Vec3>& own) const {
        return ranks->areMany() ? withGhosts.velocities : own;
    }

    /// The rank's particle at each sorted index of the neighbor list, or kGhost.
    const std::vector<std::uint32_t>& order() const { return ranks->areMany() ? withGhosts.order : list.order; }

    /// Whether the SIMD kernels serve these particles: unless there are many materials with several laws.
    bool hasLanes() const { return !table.mixtures.empty(); }

    PairConstants<double> constants(const PackedParticle& p, const PackedParticle& i) const {
        const PairConstants<double> c = table.constantsOf(materials, p.material, i.material);
        return terms.oneRadius ? c : atRestLength<true>(c, p.radius + i.radius);
    }

    /// The same without a copy where they are tabulated, which would take longer than what is computed from them.
    /// @param computed  holds them where they are not
    const PairConstants<double>& constants(const PackedParticle& p, const PackedParticle& i,
                                           PairConstants<double>& computed) const {
        const PairConstants<double>* const entry = terms.oneRadius ? table.entryOf(p.material, i.material) : nullptr;
        return entry != nullptr ? *entry : computed = constants(p, i);
    }

    /// Index, in the order of the neighbor list, of the particle in a lane slot.
    std::uint32_t sortedIndexAt(std::size_t laneSlot) const {
        return static_cast<std::uint32_t>(list.rows.ownIndices[laneSlot]);
    }

    /// Calls visit(sorted index, P, P.P) for every particle within the cutoff of the particle in a lane slot.
    template <class Visit>
    void forEachNeighbor(std::size_t laneSlot, const Visit& visit) const {
        forEachWithin(terms.cutoff, laneSlot, visit);
    }

    /// The same for every particle within a distance (m) that is at most the cutoff. Which listed neighbors lie beyond
    /// it is unpredictable, so they are filtered first, without branches.
    template <class Visit>
    void forEachWithin(double distance, std::size_t laneSlot, const Visit& visit) const {
        const PackedParticle& p = packed[sortedIndexAt(laneSlot)];
        const double reachSq = distance * distance;
        constexpr std::uint32_t kAtOnce = 128;  // neighbors filtered at a time; chosen: more than in most rows
        std::array<std::uint32_t, kAtOnce> within;
        const RowBlock& block = list.rows.blocks[NeighborRows::blockOf(laneSlot)];
        const std::size_t first = list.rows.at(laneSlot, 0);
        const std::uint32_t length = list.rows.length[laneSlot];
        for (std::uint32_t begin = 0; begin < length; begin += kAtOnce) {
            const std::uint32_t end = std::min(begin + kAtOnce, length);
            std::size_t found = 0;
            for (std::uint32_t k = begin; k < end; ++k) {
                const auto other = static_cast<std::uint32_t>(block.entries[first + k * kClusterSize]);
                within[found] = other;
                found += squaredLength(separationOf(p, packed[other])) < reachSq ? 1U : 0U;
            }
            for (std::size_t k = 0; k < found; ++k) {
                const auto visitIt = [&](const Vec3& separation, double distanceSq) {
                    visit(within[k], separation, distanceSq);
                };
                visitPair(p, packed[within[k]], visitIt);
            }
        }
    }

    /// Calls visit(P, P.P) for a pair of particles, with the stand-in coincidentSeparation() for P where the two
    /// coincide.
    template <class Visit>
    static void visitPair(const PackedParticle& p, const PackedParticle& i, const Visit& visit) {
        Vec3 separation = separationOf(p, i);
        double distanceSq = squaredLength(separation);
        if (distanceSq == 0.0) {
            separation = coincidentSeparation(p.id, i.id, p.radius + i.radius);
            distanceSq = squaredLength(separation);
        }
        visit(separation, distanceSq);
    }

    /// Calls body(lane slot) for every particle, divided among the threads.
    template <class Body>
    void forEachParticle(const Body& body) const {
        constexpr std::size_t kGrain = 64;  // fewest particles a thread; chosen: one takes up to 0.5 microseconds
        inParallel(list.count(), kGrain, body);
    }

 private:
    static Vec3 separationOf(const PackedParticle& p, const PackedParticle& i) {
        return {p.x - i.x, p.y - i.y, p.z - i.z};
    }
};

}  // namespace engine
