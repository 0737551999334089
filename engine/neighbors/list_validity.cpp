// How long a neighbor list stays valid: whether it covers positions, and the skin for which lists cost least.
#include <array>
#include <cmath>
#include <limits>

#include "engine/core/bounding_box.h"
#include "engine/neighbors/neighbor_list.h"

namespace engine {
namespace {

/// Whether a list was built for `count` particles and reaches at least as far as a cutoff (m).
bool isOf(const NeighborList& list, std::size_t count, double cutoff) {
    return count == list.builtAt.size() && cutoff <= list.reach();
}

/// Distance by which each particle may have moved since the neighbor list was built, relative to the common motion, in
/// meters.
double slackOf(const NeighborList& list, double cutoff) {
    return 0.5 * (list.reach() - cutoff);
}

/// Whether all particles have moved by at most the slack (m) relative to their group, no two groups are within the
/// cutoff (m), and none were within the list's reach when it was built. Pairs within a group are then listed, no others
/// act on each other, and no listed pair moves far apart with its groups.
bool coversGroups(const Ranks& ranks, const NeighborList& list, const std::vector<Vec3>& positions, double cutoff,
                  double slack, const FarGroups& groups) {
    const auto displacement = [&](std::size_t p) -> Vec3 { return positions[p] - list.builtAt[p]; };
    std::vector<Vec3> common = ofLeaders(ranks, groups, displacement);
    for (Vec3& moved : common)
        if (squaredLength(moved) <= slack * slack) moved = Vec3::Zero();
    const auto relative = [&](std::size_t p) -> Vec3 { return displacement(p) - common[groups.of(p)]; };
    const std::vector<Vec3> still(groups.count(), Vec3::Zero());
    return holdsOnAll(ranks, areWithin(slack, Vec3::Zero(), positions.size(), relative)) &&
           stayApart(ranks, groups, list.builtAt, still, list.reach()) &&
           stayApart(ranks, groups, positions, still, cutoff);
}

/// Cost per particle and time step of building a neighbor list and of the passes over it, in the cost of one pair.
/// Building costs as much as kPerParticle pairs for each particle, plus kPerEntry pairs for each entry of its row.
/// Measured: rows "list" and "forces" of `globular bench` at 5 to 90 neighbors, between double and float.
double costPerStep(double skin, double neighbors, double displacement) {
    constexpr double kPerParticle = 50.0;
    constexpr double kPerEntry = 2.0;
    const double entries = neighbors * (1.0 + skin) * (1.0 + skin) * (1.0 + skin);
    const double passes = 1.0 + std::floor(0.5 * skin / displacement);
    return entries + (kPerParticle + kPerEntry * entries) / passes;
}

}  // namespace

bool covers(const NeighborList& list, const std::vector<Vec3>& positions, double cutoff, const FarGroups& groups,
            const Ranks& ranks) {
    const double slack = slackOf(list, cutoff);
    const auto displacement = [&](std::size_t p) -> Vec3 { return positions[p] - list.builtAt[p]; };
    const bool isKnown = isOf(list, positions.size(), cutoff);
    // The usual case is that no particle has moved far.
    const bool areNear = isKnown && areWithin(slack, Vec3::Zero(), positions.size(), displacement);
    std::array<double, 2> fails = {isKnown ? 0.0 : 1.0, areNear ? 0.0 : 1.0};
    ranks.maximize(fails);
    if (fails[0] != 0.0) return false;
    if (fails[1] == 0.0) return true;
    if (groups.exist() && coversGroups(ranks, list, positions, cutoff, slack, groups)) return true;
    // If the displacements of two particles differ by more than 2 * slack, no common translation brings both within
    // slack. The newest particles are tested first, because they are often the fastest.
    const std::size_t some = std::min(positions.size(), kSumChunk);
    const BoundingBox newest =
        boundingBoxOf(some, [&](std::size_t p) { return displacement(positions.size() - some + p); });
    constexpr double kMargin = 1.0 + 1e-6;  // chosen: far above the rounding errors of the test below
    if (!holdsOnAll(ranks, (newest.high - newest.low).maxCoeff() <= 2.0 * kMargin * slack)) return false;
    const Vec3 middle = overRanks(ranks, boundingBoxOf(positions.size(), displacement)).middle();
    return holdsOnAll(ranks, areWithin(slack, middle, positions.size(), displacement));
}

double optimalSkin(double neighbors, double displacement) {
    // Skins that are tried. Chosen: a finer series saves no time, and wider skins take more memory.
    constexpr std::array kSkins = {0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6};
    double best = kSkins.front();
    double least = std::numeric_limits<double>::infinity();
    for (const double skin : kSkins) {
        const double cost = costPerStep(skin, neighbors, displacement);
        if (!(cost < least)) continue;  // a NaN is never chosen
        best = skin;
        least = cost;
    }
    return best;
}

}  // namespace engine
