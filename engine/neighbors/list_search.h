// The inner loop of building a neighbor list: which of the candidates in the cells around some particles are within
// reach of each. Called by neighbor_list.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/neighbors/cell_grid.h"

namespace engine {

/// How many candidates a search reads beyond the last one.
inline constexpr std::size_t kSearchOverhang = 8;

/// Positions by sorted index, m: cells lie one after the other, so that candidates are read consecutively. They are
/// followed by kSearchOverhang numbers of any value.
struct Candidates {
    std::vector<double> x, y, z;
};

/// Scratch of a search: its candidates one after the other, relative to an origin close by, where float resolves their
/// distances and twice as many fit a SIMD vector.
struct SearchScratch {
    std::vector<float> x, y, z;  ///< from the origin, in reaches
    std::vector<std::uint32_t> sortedIndices;
    std::vector<std::uint16_t> near;  ///< for each particle and vector of candidates one bit a lane: whether it is near
};

/// Rows one after the other.
struct FoundRows {
    std::vector<std::uint32_t> sortedIndices;  ///< more than are used
    std::size_t used = 0;
};

/// How far from the origin a particle may be, along each axis, for float to resolve the distances of its neighbors, in
/// reaches.
inline constexpr double kFloatRange = 8.0;

/// Particles with a squared distance below this much of the reach squared are listed. Float errs by 4e-6 of it, and no
/// pair within reach may be missed: a coordinate below 8 is rounded by 2.4e-7, one below 16 by 4.8e-7; that on each
/// axis of a distance of 1 is 2 sqrt(3) 7.2e-7 = 2.5e-6 of its square, and squares and sums add 3e-7.
inline constexpr float kFloatMargin = 1.00001F;

/// Appends a row for each particle of a range: the sorted indices of all others within reach (m) of it, in the order of
/// the neighborhood's ranges. A row has no particle whose squared distance exceeds reach^2 kFloatMargin by more than
/// float's error.
/// @param around   the ranges in and around the cells that the particles are in
/// @param own      sorted indices of the particles, side by side
/// @param lengths  receives the length of each row
void findInReach(const Candidates& candidates, const Neighborhood& around, CellRange own, double reach,
                 SearchScratch& scratch, FoundRows& rows, std::uint32_t* lengths);

}  // namespace engine
