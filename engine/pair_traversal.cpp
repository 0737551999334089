// Sorting for a visit.
#include "engine/pair_traversal.h"

#include <algorithm>
#include <bit>

#include "engine/extent.h"
#include "engine/list_skin.h"

namespace engine {
namespace {

/// Units in the reach of a list: differences within it stay below 2^24, which float holds exactly.
constexpr double kUnits = 8388608.0;

/// Rounded to a whole number, modulo 2^32; some number for what is no number or beyond all worlds. A sum with 1.5 x
/// 2^52 is rounded to a whole number that stands in its last bits: no conversion, which would need a branch for what
/// does not fit.
std::int32_t wrapped(double units) {
    constexpr double kRounding = 0x1.8p52;
    constexpr double kTurn = 0x1p32;
    const double turns = (units / kTurn + kRounding) - kRounding;
    const double rest = units - turns * kTurn;  // exact
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(rest + kRounding)));
}

/// Fetches a particle some places ahead into the cache: the list's order is not that of the particles, so that no
/// processor does it by itself. Measured with `globular bench --filter forces` on Zen 5: a tenth less time at 256,000
/// particles in float, 1 % in double, nothing at 32,000.
void fetchAhead(const NeighbourList& list, std::size_t place, const Particles& particles,
                const std::vector<Vec3>& velocities) {
    constexpr std::size_t kPlaces = 32;
    const std::size_t p = list.order[std::min(place + kPlaces, list.count() - 1)];
    __builtin_prefetch(&particles.position[p]);
    __builtin_prefetch(&velocities[p]);
}

/// How fast particles leave the place they have in the crowd, at most, m/s: what all have in common moves no list.
double fastest(const std::vector<Vec3>& velocities) {
    const auto velocity = [&](std::size_t p) -> const Vec3& { return velocities[p]; };
    return farthestFrom(extentOver(velocities.size(), velocity).middle(), velocities.size(), velocity);
}

/// Entries of a row that lie within the cutoff (m), if they are spread evenly.
double neighboursWithin(double cutoff, const NeighbourList& list) {
    const double share = cutoff / list.reach;
    return share * share * share * static_cast<double>(list.entryCount) / static_cast<double>(list.count());
}

}  // namespace

PairTraversal::PairTraversal(const ForceLaw& law, Precision wanted)
    : pairMaterials(mixedPairs(law.materials)), materialCount(law.materials.size()), precision(wanted) {}

void PairTraversal::prepare(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                            double step) {
    terms = termsFor(law, particles);
    if (terms.uniform && particles.count() > 0) {
        uniformRadius = particles.radius.front();
        uniform = pairConstants<double>(pairMaterials.front(), 2.0 * uniformRadius);
    }
    if (!covers(list, particles.position, terms.cutoff)) {
        const bool isForeseen = step > 0.0 && list.count() > 0 && particles.count() > 0;
        const double skin =
            isForeseen ? cheapestSkin(neighboursWithin(terms.cutoff, list), step * fastest(velocities) / terms.cutoff)
                       : kListSkin;
        build(list, particles.position, terms.cutoff, skin * terms.cutoff);
    }
    const bool hasSingles = terms.uniform && precision == Precision::singles;
    hasRecords = false;
    if (!hasSingles) makeRecords(particles, velocities);
    singles.resize(hasSingles ? particles.count() : 0);
    unit = list.reach / kUnits;
    const double perUnit = 1.0 / unit;
    inParallel(singles.size(), kParticleGrain, [&](std::size_t place) {
        const std::size_t p = list.order[place];
        fetchAhead(list, place, particles, velocities);
        const Vec3& x = particles.position[p];
        const Vec3 units = x * perUnit;
        const Vec3& v = velocities[p];
        singles[place] = {wrapped(units.x()),        wrapped(units.y()),         wrapped(units.z()),
                          particles.id[p],           static_cast<float>(v.x()),  static_cast<float>(v.y()),
                          static_cast<float>(v.z()), restOf(x.x(), x.y(), x.z())};
    });
}

void PairTraversal::makeRecords(const Particles& particles, const std::vector<Vec3>& velocities) {
    if (hasRecords) return;
    hasRecords = true;
    records.resize(particles.count());
    inParallel(records.size(), kParticleGrain, [&](std::size_t place) {
        const std::size_t p = list.order[place];
        fetchAhead(list, place, particles, velocities);
        const Vec3& x = particles.position[p];
        const Vec3& v = velocities[p];
        records[place] = {x.x(),          x.y(), x.z(), v.x(), v.y(), v.z(), particles.radius[p], particles.material[p],
                          particles.id[p]};
    });
}

}  // namespace engine
