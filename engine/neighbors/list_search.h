// The inner loop of building a neighbor list: finds, for each particle of a group, which particles of the cells around
// the group (the candidates) are within reach. Called by neighbor_list.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/neighbors/cell_grid.h"

namespace engine {

/// Number of entries that a search reads beyond the last candidate.
inline constexpr std::size_t kSearchOverhang = 8;

/// Positions of all particles in the order of the cells, m, so that the candidates of a search are read consecutively.
/// The arrays end with kSearchOverhang numbers of any value.
struct Candidates {
    std::vector<double> x, y, z;
};

/// Work memory of a search. The positions of the candidates are copied to float, relative to an origin close to them,
/// where float resolves their distances. A SIMD vector holds twice as many floats as doubles.
struct SearchScratch {
    std::vector<float> x, y, z;  ///< positions of candidates relative to the origin, in reaches
    std::vector<std::uint32_t> sortedIndices;
    std::vector<std::uint16_t> near;  ///< one bit for each pair of particle and candidate: whether it is near
};

/// The neighbors that searches have found, one row for each particle, one row after the other.
struct FoundRows {
    std::vector<std::uint32_t> sortedIndices;  ///< neighbors' sorted indices; entries may be left over
    std::size_t used = 0;
};

/// Largest distance of a particle from the origin of a search, along each axis and in reaches, at which float resolves
/// the distances of its neighbors.
inline constexpr double kFloatRange = 8.0;

/// Pairs whose squared distance is below this factor times the squared reach are listed. The factor is above 1 so that
/// no pair within reach is missed, although float is wrong by up to 4e-6 of the squared reach: a coordinate below 8 is
/// rounded by 2.4e-7, one below 16 by 4.8e-7; that on each axis of a distance of 1 is 2 sqrt(3) 7.2e-7 = 2.5e-6 of its
/// square, and squares and sums add 3e-7.
inline constexpr float kFloatMargin = 1.00001F;

/// Appends a row of neighbors for each particle of a range: the sorted indices of all other particles within reach (m),
/// in the order of the ranges. A row contains no particle whose squared distance exceeds reach^2 kFloatMargin by more
/// than the rounding error of float.
/// @param around   ranges of sorted indices (positions in the order of the cells) of the candidates, which include the
///                 particles of `own`
/// @param own      range of sorted indices of the particles that get rows
/// @param skipped  0; or, if `around` begins with `own` and none of these are to be neighbors of each other, their
/// number
/// @param lengths  receives the length of each row
void findInReach(const Candidates& candidates, std::span<const CellRange> around, CellRange own, std::uint32_t skipped,
                 double reach, SearchScratch& scratch, FoundRows& rows, std::uint32_t* lengths);

}  // namespace engine
