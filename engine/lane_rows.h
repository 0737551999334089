// Rows of neighbours as vector units read them: a particle a lane, sixteen particles a group, the rows of a group
// interleaved. Every lane walks its own row in the list's order, so that a sum over it does not depend on how many
// lanes an instruction set has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

/// As many lanes as the widest instruction set has of the smallest number.
inline constexpr std::size_t kGroup = 16;

/// Rows that are shorter than the longest of their group are filled up with their own particle's place.
struct LaneRows {
    std::vector<std::uint32_t> start;   ///< of each group, in rows of kGroup entries, and one past the last
    std::vector<std::uint32_t> length;  ///< entries of each place's row; 0 beyond the last place
    std::vector<std::int32_t> places;

    std::size_t groupCount() const { return start.empty() ? 0 : start.size() - 1; }

    /// Where entry k of a place's row stands.
    std::size_t at(std::size_t place, std::size_t k) const {
        return (start[place / kGroup] + k) * kGroup + place % kGroup;
    }
};

}  // namespace engine
