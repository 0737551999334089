// Rows of neighbours as vector units read them: a particle a lane, sixteen particles a group, the rows of a group
// interleaved. Every lane walks its own row in the list's order, so that a sum over it does not depend on how many
// lanes an instruction set has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

/// As many lanes as the widest instruction set has of the smallest number.
inline constexpr std::size_t kGroup = 16;

/// Groups whose rows are found and kept together, and whose neighbours are mostly the same. Chosen: some tens of
/// microseconds in a dense scene.
inline constexpr std::size_t kGroupsPerPart = 8;

/// Seats of a part.
inline constexpr std::size_t kSeatsPerPart = kGroupsPerPart * kGroup;

/// The rows of some groups.
struct RowPart {
    std::array<std::uint32_t, kGroupsPerPart + 1> start = {};  ///< of each group, in rows of kGroup entries
    std::vector<std::int32_t> places;                          ///< kernels read one row beyond the last
};

/// Each particle has a seat, a lane of a group, beside others with rows of like length. Rows that are shorter than the
/// longest of their group are filled up with their own particle's place.
struct LaneRows {
    std::vector<std::int32_t> selves;   ///< place of the particle in each seat; beyond the last, the last one
    std::vector<std::uint32_t> length;  ///< entries of each seat's row; 0 beyond the last
    std::vector<RowPart> parts;

    std::size_t groupCount() const { return selves.size() / kGroup; }

    static std::size_t partOf(std::size_t seat) { return seat / kSeatsPerPart; }

    /// Where entry k of a seat's row stands in its part.
    std::size_t at(std::size_t seat, std::size_t k) const {
        const std::size_t group = seat % kSeatsPerPart / kGroup;
        return (parts[partOf(seat)].start[group] + k) * kGroup + seat % kGroup;
    }

    /// Entry k of a seat's row, those after it kGroup apart.
    const std::int32_t* entry(std::size_t seat, std::size_t k) const {
        return &parts[partOf(seat)].places[at(seat, k)];
    }
};

}  // namespace engine
