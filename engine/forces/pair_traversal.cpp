// Brings the neighbor list up to date and packs particles for a pass over pairs.
#include "engine/forces/pair_traversal.h"

#include <algorithm>
#include <span>

#include "engine/core/bounding_box.h"

namespace engine {
namespace {

/// Number of fixed-point units in the reach of a neighbor list, 2^23. Separations of listed pairs then stay below 2^24
/// units, which a float holds exactly.
constexpr double kUnits = 8388608.0;

/// Upper bound on the speed (m/s) of any particle relative to the motion that all particles, or all of its group, have
/// in common. A common motion does not make a neighbor list outdated.
double largestRelativeSpeed(const std::vector<Vec3>& velocities, const FarGroups& groups) {
    const auto velocity = [&](std::size_t p) -> Vec3 {
        return groups.exist() ? Vec3(velocities[p] - velocities[groups.leaders[groups.of(p)]]) : velocities[p];
    };
    return farthestFrom(boundingBoxOf(velocities.size(), velocity).middle(), velocities.size(), velocity);
}

/// Estimates the mean number of neighbors within the cutoff (m) from the number of listed neighbors, which lie within
/// the larger reach of the list.
/// @param reach  of the list for the pairs with this cutoff, m
double neighborsWithin(double cutoff, double reach, const NeighborList& list) {
    const double share = cutoff / reach;
    return share * share * share * static_cast<double>(list.entryCount) / static_cast<double>(list.count());
}

}  // namespace

PairTraversal::PairTraversal(const ForceField& field, Precision wanted)
    : materials(field.materials), table(field.materials), precision(wanted) {}

void PairTraversal::renewList(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                              double step) {
    terms = termsFor(field, particles);
    if (covers(list, particles.position, terms.cutoff, groups)) return;
    const std::span<const double> radii = terms.oneRadius ? std::span<const double>{} : particles.radius;
    // Where sizes differ much, the skin is chosen for the size of which there are most.
    const double relativeRadius = typicalRelativeRadius(radii);
    const double cutoff = relativeRadius * terms.cutoff;
    double skin = kDefaultSkin;
    if (step > 0.0 && list.count() > 0 && particles.count() > 0)
        skin = optimalSkin(neighborsWithin(cutoff, relativeRadius * list.cutoff + list.skin, list),
                           step * largestRelativeSpeed(velocities, groups) / cutoff);
    build(list, particles.position, radii, terms.cutoff, skin * cutoff);
    isPacked = false;  // the new list has the particles in another order
}

void PairTraversal::prepare(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                            double step) {
    renewList(field, particles, velocities, step);
    isPacked = false;
    packedFloat.clear();
    if (particles.count() == 0) return;
    const bool isFloat = hasLanes() && precision == Precision::singles;
    unit = isFloat ? list.reach() / kUnits : 1.0;
    const double restLength = terms.oneRadius ? 2.0 * particles.radius.front() : 0.0;
    table.fill(terms.pair, restLength);
    if (!isFloat) return packParticles(particles, velocities);
    packFloats(list, particles, velocities, unit, packedFloat);
}

void PairTraversal::packParticles(const Particles& particles, const std::vector<Vec3>& velocities) {
    if (!isPacked) packDoubles(list, particles, velocities, packed);
    isPacked = true;
}

}  // namespace engine
