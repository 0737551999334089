// Searches for pairs of particles that start too close, with a neighbor list. Particles that touch those of another
// body are where they belong.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "engine/neighbors/neighbor_list.h"
#include "engine/neighbors/pair_estimate.h"
#include "scenes/warnings/start_findings.h"

namespace scenes {
namespace {

/// Particles of different bodies that are closer than this share of their rest length show that the bodies overlap.
/// Chosen: hardly any place in a close packing is further than that from all particles (0.71 is the most), while
/// neighbors in bodies side by side, or in a liquid under its own weight, are further apart.
constexpr double kOverlapShare = 0.6;

/// Particles of one body that are closer than their core and than this share of their rest length are packed too
/// closely. Chosen: the published figures of repulsion alone start with particles at a third of it, on purpose.
constexpr double kPackedShare = 0.3;

/// Most pairs of neighbors that are listed one by one. Chosen: they take about a second.
constexpr double kMostPairs = 2e7;

/// A factor just below 1, with which a lattice whose spacing is a least distance is not too close by rounding.
constexpr double kRounding = 1.0 - 1e-6;

/// Pairs of particles of two bodies, or of one, that are too close.
struct ClosePairs {
    std::size_t count = 0;
    std::uint32_t first = 0;                                   ///< the first particle that is in one of them
    double closest = std::numeric_limits<double>::infinity();  ///< smallest distance, in rest lengths
};

/// Close pairs by the indices of their bodies, the lower one first.
using PairsOfBodies = std::map<std::array<std::uint32_t, 2>, ClosePairs>;

/// The distance, in rest lengths, below which two particles are too close.
double leastDistance(const Scene& scene, std::uint32_t p, std::uint32_t q, bool areOfOneBody) {
    const engine::Material& a = scene.setup.materials[scene.setup.initial.material[p]];
    const engine::Material& b = scene.setup.materials[scene.setup.initial.material[q]];
    const double core = &a == &b ? a.coreFraction : mixed(a, b).coreFraction;
    return kRounding * (areOfOneBody ? std::min(core, kPackedShare) : std::max(core, kOverlapShare));
}

/// The largest distance that may be too close, in rest lengths.
double largestLeastDistance(const Scene& scene) {
    double reach = scene.tables.bodies.size() > 1 ? kOverlapShare : 0.0;
    for (const engine::Material& material : scene.setup.materials) reach = std::max(reach, material.coreFraction);
    return reach;
}

/// The pairs in a sample of the particles that are too close.
PairsOfBodies closePairs(const Scene& scene, std::uint64_t stride) {
    const engine::Particles& particles = scene.setup.initial;
    const std::vector<std::uint32_t> sample = engine::sampleOf(particles.count(), stride);
    std::vector<engine::Vec3> positions;
    std::vector<double> radii;
    for (const std::uint32_t p : sample) {
        positions.push_back(particles.position[p]);
        radii.push_back(particles.radius[p]);
    }
    PairsOfBodies found;
    if (sample.size() < 2) return found;
    const double largestRadius = *std::max_element(radii.begin(), radii.end());
    engine::NeighborList list;
    build(list, positions, radii, largestLeastDistance(scene) * 2.0 * largestRadius, 0.0);
    for (std::size_t slot = 0; slot < list.count(); ++slot) {
        const std::uint32_t p = sample[list.order[static_cast<std::size_t>(list.rows.ownIndices[slot])]];
        for (std::uint32_t k = 0; k < list.rows.length[slot]; ++k) {
            const std::uint32_t q = sample[list.order[list.rows.sortedIndexAt(slot, k)]];
            if (q < p) continue;
            const double distance = std::sqrt(engine::squaredLength(particles.position[p] - particles.position[q])) /
                                    (particles.radius[p] + particles.radius[q]);
            const std::array bodies = {bodyOf(scene, p), bodyOf(scene, q)};
            if (distance >= leastDistance(scene, p, q, bodies[0] == bodies[1])) continue;
            ClosePairs& pairs = found[bodies];
            if (pairs.count++ == 0 || p < pairs.first) pairs.first = p;
            pairs.closest = std::min(pairs.closest, distance);
        }
    }
    return found;
}

}  // namespace

void findClosePairs(const Scene& scene, StartMessages& messages) {
    const engine::Particles& particles = scene.setup.initial;
    if (particles.count() < 2) return;
    const double largestRadius = *std::max_element(particles.radius.begin(), particles.radius.end());
    const double pairCount = engine::estimatePairCount(particles.position, particles.radius,
                                                       largestLeastDistance(scene) * 2.0 * largestRadius);
    const std::uint64_t stride =
        pairCount <= kMostPairs ? 1
                                : engine::strideFor(static_cast<double>(particles.count()), engine::kPairSampleCount);
    const double weight = static_cast<double>(stride) * static_cast<double>(stride);
    for (const auto& [bodies, pairs] : closePairs(scene, stride)) {
        const bool areOfOneBody = bodies[0] == bodies[1];
        const std::string what =
            areOfOneBody ? fmt::format("body {} starts", bodies[0] + 1)
                         : fmt::format("bodies {} and {} overlap: they start", bodies[0] + 1, bodies[1] + 1);
        messages.add(
            scene.tables.bodies[bodies[1]],
            fmt::format("{} with {} of particles closer than {}, the closest at {:.2g} rest lengths, e.g. at {}; {}",
                        what, countText(pairs.count, weight, "pair", "pairs"),
                        areOfOneBody ? "their core" : fmt::format("{:g} rest lengths", kOverlapShare), pairs.closest,
                        positionText(scene.setup.initial.position[pairs.first]),
                        areOfOneBody ? "give it a larger spacing, or its particles a smaller radius"
                                     : "move them apart, or make one smaller"));
    }
    messages.endKind();
}

}  // namespace scenes
