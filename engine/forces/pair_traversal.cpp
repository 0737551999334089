// Brings the neighbor list up to date and packs particles for a pass over pairs.
#include "engine/forces/pair_traversal.h"

#include <algorithm>
#include <array>
#include <span>

#include "engine/core/bounding_box.h"
#include "engine/core/random.h"

namespace engine {
namespace {

/// Number of fixed-point units in the reach of a neighbor list, 2^23. Separations of listed pairs then stay below 2^24
/// units, which a float holds exactly.
constexpr double kUnits = 8388608.0;

/// Upper bound on the speed (m/s) of any particle relative to the motion that all particles, or all of its group, have
/// in common. A common motion does not make a neighbor list outdated.
double largestRelativeSpeed(const Ranks& ranks, const std::vector<Vec3>& velocities, const FarGroups& groups) {
    const std::vector<Vec3> common = ofLeaders(ranks, groups, [&](std::uint32_t leader) { return velocities[leader]; });
    const auto velocity = [&](std::size_t p) -> Vec3 {
        return groups.exist() ? Vec3(velocities[p] - common[groups.of(p)]) : velocities[p];
    };
    const Vec3 middle = overRanks(ranks, boundingBoxOf(velocities.size(), velocity)).middle();
    return largestOfAll(ranks, farthestFrom(middle, velocities.size(), velocity));
}

/// The share of the particles whose neighbors are counted is one in kSampled, chosen by their ids, or all if they are
/// few. Chosen: the counts then take a hundredth of the time of the list.
constexpr std::uint64_t kSampled = 32;
constexpr std::uint64_t kFew = 4096;

/// Numbers of particles and of their neighbors.
struct NeighborCounts {
    std::int64_t particles = 0;
    std::int64_t neighbors = 0;

    NeighborCounts& operator+=(const NeighborCounts& other) {
        particles += other.particles;
        neighbors += other.neighbors;
        return *this;
    }
};

/// Number of neighbors of the particle in a lane slot within the cutoff of each pair, where the list was built.
/// @param particles  those that the list is of
std::int64_t neighborCount(const NeighborList& list, std::size_t laneSlot, const Particles& particles,
                           const SizeTable& sizes) {
    const Candidates& at = list.scratch.candidates;
    const auto self = static_cast<std::uint32_t>(list.rows.ownIndices[laneSlot]);
    std::int64_t count = 0;
    for (std::uint32_t k = 0; k < list.rows.length[laneSlot]; ++k) {
        const std::uint32_t other = list.rows.sortedIndexAt(laneSlot, k);
        double cutoff = list.cutoff;
        if (!sizes.areEqual)
            cutoff *= 0.5 * (particles.radius[list.order[self]] + particles.radius[list.order[other]]) /
                      sizes.largestRadius();
        const Vec3 apart(at.x[self] - at.x[other], at.y[self] - at.y[other], at.z[self] - at.z[other]);
        count += squaredLength(apart) <= cutoff * cutoff ? 1 : 0;
    }
    return count;
}

}  // namespace

PairTraversal::PairTraversal(const ForceField& field, Precision wanted, const Ranks& ofRun)
    : ranks(&ofRun), materials(field.materials), table(field.materials), precision(wanted) {}

void PairTraversal::renewList(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                              double step) {
    terms = termsFor(field, particles, *ranks);
    if (!covers(list, particles.position, terms.cutoff, groups, *ranks)) {
        // Where sizes differ much, the skin is chosen for the size of which there are most.
        const double cutoff = typicalRelativeRadius(sizesOf(*ranks, particles.radius)) * terms.cutoff;
        double skin = kDefaultSkin;
        if (step > 0.0 && meanNeighbors && terms.largestRadius > 0.0)
            skin = optimalSkin(*meanNeighbors, step * largestRelativeSpeed(*ranks, velocities, groups) / cutoff);
        buildList(particles, particles.position, terms.cutoff, skin * cutoff);
    }
    if (ranks->areMany()) fetchGhosts(*ranks, particles.position, velocities, withGhosts);
}

void PairTraversal::buildList(const Particles& particles, const std::vector<Vec3>& positions, double cutoff,
                              double skin) {
    const auto radii = std::span(particles.radius).first(positions.size());
    const SizeTable sizes = sizesOf(*ranks, radii);
    if (ranks->areMany()) {
        findGhosts(*ranks, particles, positions, cutoff + skin, withGhosts);
        build(list, withGhosts.particles.position, withGhosts.particles.radius, cutoff, skin, sizes,
              withGhosts.halo.isGhost);
        list.builtAt = positions;
        withGhosts.order.clear();
        for (const std::uint32_t j : list.order)
            withGhosts.order.push_back(withGhosts.halo.isGhost[j] != 0 ? kGhost : withGhosts.halo.ownOf[j]);
    } else {
        build(list, positions, radii, cutoff, skin, sizes, {});
    }
    countNeighbors(listed(particles), sizes);
    isPacked = false;  // the new list has the particles in another order
}

void PairTraversal::countNeighbors(const Particles& particles, const SizeTable& sizes) {
    const bool areFew = sumOfAll(*ranks, list.builtAt.size()) <= kFew;
    const auto counts = sumOver<NeighborCounts>(list.count(), [&](std::size_t laneSlot) -> NeighborCounts {
        const std::uint32_t p = list.order[sortedIndexAt(laneSlot)];
        if (!areFew && scatter(particles.id[p]) % kSampled != 0) return {};
        if (ranks->areMany() && withGhosts.halo.isGhost[p] != 0) return {};
        return {1, neighborCount(list, laneSlot, particles, sizes)};
    });
    std::array<std::int64_t, 2> sums = {counts.particles, counts.neighbors};
    ranks->sum(sums);
    meanNeighbors.reset();
    if (sums[0] > 0) meanNeighbors = static_cast<double>(sums[1]) / static_cast<double>(sums[0]);
}

void PairTraversal::prepare(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                            double step) {
    renewList(field, particles, velocities, step);
    isPacked = false;
    packedFloat.clear();
    if (list.count() == 0) return;
    const bool isFloat = hasLanes() && precision == Precision::singles;
    unit = isFloat ? list.reach() / kUnits : 1.0;
    table.fill(terms.oneRadius ? 2.0 * terms.largestRadius : 0.0);
    if (!isFloat) return packParticles(particles, velocities);
    packFloats(list, listed(particles), listedVelocities(velocities), unit, packedFloat);
}

void PairTraversal::packParticles(const Particles& particles, const std::vector<Vec3>& velocities) {
    if (isPacked) return;
    packDoubles(list, listed(particles), listedVelocities(velocities), packed);
    isPacked = true;
}

}  // namespace engine
