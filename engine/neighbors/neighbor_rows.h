// Rows of neighbors as vector units read them: a particle a lane, sixteen particles a group, the rows of a group
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

/// Groups whose rows are found and kept together, and whose neighbors are mostly the same. Chosen: some tens of
/// microseconds in a dense scene.
inline constexpr std::size_t kGroupsPerPart = 8;

/// Seats of a part.
inline constexpr std::size_t kSeatsPerPart = kGroupsPerPart * kGroup;

/// The rows of some groups: places counted from a base, in half a word each, unless what is around the groups spans too
/// many of them. Kernels read one row beyond the last.
struct RowPart {
    std::array<std::uint32_t, kGroupsPerPart + 1> start = {};  ///< of each group, in rows of kGroup entries
    std::uint32_t base = 0;
    std::vector<std::uint16_t> narrow;
    std::vector<std::int32_t> wide;  ///< empty where narrow ones suffice

    bool isWide() const { return !wide.empty(); }

    /// The place that an entry stands for.
    std::uint32_t placeAt(std::size_t at) const {
        return base + (isWide() ? static_cast<std::uint32_t>(wide[at]) : narrow[at]);
    }

    std::size_t bytes() const { return narrow.capacity() * sizeof(narrow[0]) + wide.capacity() * sizeof(wide[0]); }

    void setPlace(std::size_t at, std::uint32_t place) {
        if (isWide())
            wide[at] = static_cast<std::int32_t>(place - base);
        else
            narrow[at] = static_cast<std::uint16_t>(place - base);
    }
};

/// A part's entries of either width.
template <class Entry, class Part>
auto& entriesOf(Part& part) {
    if constexpr (sizeof(Entry) == sizeof(std::uint16_t))
        return part.narrow;
    else
        return part.wide;
}

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

    /// The place that entry k of a seat's row stands for.
    std::uint32_t placeAt(std::size_t seat, std::size_t k) const { return parts[partOf(seat)].placeAt(at(seat, k)); }
};

}  // namespace engine
