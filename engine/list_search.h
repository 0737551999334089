// The inner loop of building a neighbour list: which of the candidates in the cells around a particle are within reach.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/neighbours.h"

namespace engine {

/// Candidates that findInReach reads and entries that it writes beyond those that there are.
inline constexpr std::size_t kSearchOverhang = 8;

/// Positions by place, m: cells lie one after the other, so that candidates are read in a row. After the last one come
/// kSearchOverhang more of any value.
struct Candidates {
    std::vector<double> x, y, z;
};

/// Writes the places of all others within reach of the particle at a place, in the order of the neighbourhood's ranges,
/// and returns where they end. `out` has room for every candidate and the overhang.
std::uint32_t* findInReach(const Candidates& candidates, const Neighbourhood& around, std::uint32_t self,
                           double reachSq, std::uint32_t* out);

}  // namespace engine
