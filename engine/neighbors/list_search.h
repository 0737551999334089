// The inner loop of building a neighbor list: which of the candidates in the cells around some particles are within
// reach of each.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/neighbors/cell_grid.h"

namespace engine {

/// Candidates that a search reads beyond those that there are.
inline constexpr std::size_t kSearchOverhang = 8;

/// Positions by sortedIndex, m: cells lie one after the other, so that candidates are read in a row. After the last one
/// come kSearchOverhang more of any value.
struct Candidates {
    std::vector<double> x, y, z;
};

/// Candidates side by side, seen from an origin close by: there float tells distances apart, and twice as many fit a
/// vector. Scratch of a search.
struct Surroundings {
    std::vector<float> x, y, z;  ///< from the origin, in reaches
    std::vector<std::uint32_t> sortedIndices;
    std::vector<std::uint16_t> near;  ///< for each particle and vector of candidates a bit a lane: whether it is near
};

/// Rows one after the other, each followed by its padding.
struct FoundRows {
    std::vector<std::uint32_t> sortedIndices;  ///< more than are used
    std::size_t used = 0;
};

/// How far from the origin a particle may be, along each axis, for float to tell apart what is near to it, in reaches.
inline constexpr double kClearSight = 8.0;

/// Of the reach squared: float errs by 4e-6 of it, and no pair within may be missed. A coordinate below 8 is rounded by
/// 2.4e-7, one below 16 by 4.8e-7; that on each axis of a distance of 1 is 2 sqrt(3) 7.2e-7 = 2.5e-6 of its square, and
/// squares and sums add 3e-7.
inline constexpr float kFloatMargin = 1.00001F;

/// Appends for one sortedIndex of a run of cells after the other the row of the sortedIndices of all others within
/// reach (m) of it, in the order of the neighborhood's ranges; of none whose distance squared is beyond reach^2
/// kFloatMargin by more than float's error. Writes the length of each.
void findInReach(const Candidates& candidates, const Neighborhood& around, CellRange ownIndices, double reach,
                 Surroundings& scratch, FoundRows& rows, std::uint32_t* lengths);

}  // namespace engine
