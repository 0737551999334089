// Sorting for a visit.
#include "engine/forces/pair_traversal.h"

#include <algorithm>

#include "engine/core/bounding_box.h"
#include "engine/forces/pack_particles.h"
#include "engine/neighbors/verlet_skin.h"

namespace engine {
namespace {

/// Units in the reach of a list: differences within it stay below 2^24, which float holds exactly.
constexpr double kUnits = 8388608.0;

/// How fast particles leave the sortedIndex they have in the crowd, at most, m/s: what all have in common moves no
/// list.
double fastest(const std::vector<Vec3>& velocities) {
    const auto velocity = [&](std::size_t p) -> const Vec3& { return velocities[p]; };
    return farthestFrom(boundingBoxOf(velocities.size(), velocity).middle(), velocities.size(), velocity);
}

/// Entries of a row that lie within the cutoff (m), if they are spread evenly.
double neighborsWithin(double cutoff, const NeighborList& list) {
    const double share = cutoff / list.reach;
    return share * share * share * static_cast<double>(list.entryCount) / static_cast<double>(list.count());
}

}  // namespace

PairTraversal::PairTraversal(const ForceLaw& law, Precision wanted)
    : pairMaterials(mixedPairs(law.materials)), materialCount(law.materials.size()), precision(wanted) {}

void PairTraversal::renewList(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                              double step) {
    terms = termsFor(law, particles);
    if (covers(list, particles.position, terms.cutoff)) return;
    const bool isStepKnown = step > 0.0 && list.count() > 0 && particles.count() > 0;
    const double skin =
        isStepKnown ? optimalSkin(neighborsWithin(terms.cutoff, list), step * fastest(velocities) / terms.cutoff)
                    : kDefaultSkin;
    build(list, particles.position, terms.cutoff, skin * terms.cutoff);
    arePacked = false;  // they are in another order
}

void PairTraversal::prepare(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                            double step) {
    renewList(law, particles, velocities, step);
    if (terms.uniform && particles.count() > 0) {
        uniformRadius = particles.radius.front();
        uniform = pairConstants<double>(pairMaterials.front(), 2.0 * uniformRadius);
    }
    const bool hasSingles = terms.uniform && precision == Precision::singles;
    arePacked = false;
    if (!hasSingles) packParticles(particles, velocities);
    packedFloats.resize(hasSingles ? particles.count() : 0);
    unit = list.reach / kUnits;
    const SortedParticles from(list, particles, velocities);
    inRanges(packedFloats.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        packFloats(from, 1.0 / unit, begin, end, packedFloats.data());
    });
}

void PairTraversal::forgetList() {
    list.builtAt.clear();
    list.sortedIndexOf.clear();
}

void PairTraversal::packParticles(const Particles& particles, const std::vector<Vec3>& velocities) {
    if (arePacked) return;
    arePacked = true;
    packed.resize(particles.count());
    const SortedParticles from(list, particles, velocities);
    inRanges(packed.size(), kParticleGrain,
             [&](std::size_t begin, std::size_t end) { packDoubles(from, begin, end, packed.data()); });
}

}  // namespace engine
