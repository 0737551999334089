// Groups of particles that are far from each other, for example a body at rest and crumbs that have fallen off it. Each
// group may move as a whole, however fast, without harm to the neighbor list or to the step: only motion within a group
// counts, as long as the groups stay apart. Found between frames by stepping/free_groups.cpp; used by covers() of the
// neighbor list and by the audit of steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// A division of particles into groups that were apart when they were found. They may have met since, so code that
/// relies on them calls stayApart() first.
struct FarGroups {
    std::vector<std::uint32_t> groupOf;  ///< group of each particle index; empty if there are not at least two groups
    std::vector<std::uint32_t> leaders;  ///< lowest particle index of each group

    bool exist() const { return !leaders.empty(); }
    std::size_t count() const { return leaders.size(); }

    /// Group of a particle. One that was emitted after the groups were found counts to the largest group, which is 0.
    std::uint32_t of(std::size_t p) const { return p < groupOf.size() ? groupOf[p] : 0; }
};

/// Divides particles into groups such that particles of two groups are farther apart than a distance (m). Not every gap
/// of this width is found, but every one of twice this width along an axis is. Positions must be finite.
FarGroups findFarGroups(const std::vector<Vec3>& positions, double distance);

/// Whether particles of two groups stay farther apart than a distance (m) while each group moves along a straight line.
/// Judged by the bounding boxes of the groups, so true is certain and false may mean that it is not known.
/// @param positions  at the start, in meters; must be finite
/// @param motions    displacement of each group, in meters; a NaN gives false
bool stayApart(const FarGroups& groups, const std::vector<Vec3>& positions, const std::vector<Vec3>& motions,
               double distance);

}  // namespace engine
