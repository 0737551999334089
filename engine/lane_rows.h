// The neighbour list as vector units read it: a particle a lane, sixteen particles a group, the rows of a group
// interleaved. Every lane walks its own row in the list's order, so that a sum over it does not depend on how many
// lanes an instruction set has.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/neighbour_list.h"

namespace engine {

/// As many lanes as the widest instruction set has of the smallest number.
inline constexpr std::size_t kGroup = 16;

/// Entry k of a group's rows stands at (start + k) kGroup + lane; a row that is shorter than the group's longest is
/// filled up with its own particle's place.
struct LaneRows {
    std::vector<std::uint32_t> start;   ///< of each group, in rows of kGroup entries, and one past the last
    std::vector<std::uint32_t> length;  ///< entries of each place's row; 0 beyond the last place
    std::vector<std::int32_t> places;

    std::size_t groupCount() const { return start.empty() ? 0 : start.size() - 1; }
};

void build(LaneRows& rows, const NeighbourList& list);

}  // namespace engine
