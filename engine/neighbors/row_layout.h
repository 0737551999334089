// Laying the rows of a cluster side by side. Used by the neighbor list, whose rows are found one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/neighbors/neighbor_rows.h"

namespace engine {

/// What follows a row that was found: its own particle's sortedIndex, so often.
inline constexpr std::size_t kRowPadding = 16;

/// The rows of a cluster by lane, each with its padding.
struct ClusterRows {
    std::array<const std::uint32_t*, kClusterSize> row = {};
    std::array<std::uint32_t, kClusterSize> length = {};
    std::uint32_t longest = 0;
};

/// Writes the first entries of all lanes, then the second ones, and so on, each counted from a base: none is less, nor
/// more than it by what an entry cannot hold.
/// Shape:  to: room for as many times kClusterSize as the longest row has.
void interleave(const ClusterRows& rows, std::uint32_t base, std::uint16_t* to);
void interleave(const ClusterRows& rows, std::uint32_t base, std::int32_t* to);

}  // namespace engine
