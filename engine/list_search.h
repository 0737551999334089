// The inner loop of building a neighbour list: which of the candidates in the cells around a particle are within reach.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/neighbours.h"

namespace engine {

/// Positions by place, m: cells lie one after the other, so that candidates are read in a row.
struct Candidates {
    std::vector<double> x, y, z;
};

/// Entries that findInReach may write beyond those it finds.
inline constexpr std::size_t kSearchOverhang = 16;

/// Writes the places of all others within reach of the particle at a place, in the order of the neighbourhood's ranges,
/// and returns where they end. `out` has room for every candidate and the overhang.
std::uint32_t* findInReach(const Candidates& candidates, const Neighbourhood& around, std::uint32_t self,
                           double reachSq, std::uint32_t* out);

}  // namespace engine
