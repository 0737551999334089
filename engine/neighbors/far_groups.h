// Groups of particles that are far from each other, for example a body at rest and crumbs that have fallen off it. Each
// group may move as a whole, however fast, without harm to the neighbor list or to the step: only motion within a group
// counts, as long as the groups stay apart. Found between frames by stepping/free_groups.cpp; used by covers() of the
// neighbor list and by the audit of steps.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/ranks/ranks.h"

namespace engine {

/// A division of particles into groups that were apart when they were found. They may have met since, so code that
/// relies on them calls stayApart() first.
struct FarGroups {
    /// No particle of this rank.
    static constexpr std::uint32_t kElsewhere = 0xFFFFFFFF;

    std::vector<std::uint32_t> groupOf;  ///< group of each particle index; empty if there are not at least two groups
    /// Index of the particle with the lowest id of each group; kElsewhere if another rank has it.
    std::vector<std::uint32_t> leaders;

    bool exist() const { return !leaders.empty(); }
    std::size_t count() const { return leaders.size(); }

    /// Group of a particle. One that was emitted after the groups were found counts to the largest group, which is 0.
    std::uint32_t of(std::size_t p) const { return p < groupOf.size() ? groupOf[p] : 0; }
};

/// Divides the particles of all ranks into groups such that particles of two groups are farther apart than a distance
/// (m). Not every gap of this width is found, but every one of twice this width along an axis is. Positions must be
/// finite.
/// @param ids  of the rank's particles, ascending
FarGroups findFarGroups(const Ranks& ranks, const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& ids,
                        double distance);

/// A vector of the leader of each group, which is known on the leader's rank: vectorOf(leader). A component that is NaN
/// is given as infinity.
template <class VectorOf>
std::vector<Vec3> ofLeaders(const Ranks& ranks, const FarGroups& groups, const VectorOf& vectorOf) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Vec3> vectors(groups.count(), Vec3::Constant(-kInfinity));
    for (std::size_t group = 0; group < groups.count(); ++group) {
        if (groups.leaders[group] == FarGroups::kElsewhere) continue;
        const Vec3 vector = vectorOf(groups.leaders[group]);
        for (int axis = 0; axis < 3; ++axis) vectors[group][axis] = std::isnan(vector[axis]) ? kInfinity : vector[axis];
    }
    if (!vectors.empty()) ranks.maximize({vectors.front().data(), 3 * vectors.size()});
    return vectors;
}

/// Whether particles of two groups stay farther apart than a distance (m) while each group moves along a straight line.
/// Judged by the bounding boxes of the groups, so true is certain and false may mean that it is not known.
/// @param positions  of the rank's particles at the start, in meters; must be finite
/// @param motions    displacement of each group, in meters; a NaN gives false
bool stayApart(const Ranks& ranks, const FarGroups& groups, const std::vector<Vec3>& positions,
               const std::vector<Vec3>& motions, double distance);

}  // namespace engine
