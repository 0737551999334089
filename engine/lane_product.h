// The pairs' share of a product with the implicit steppers' matrix, a particle a lane. Called by multiply().
#pragma once

#include <array>

#include "engine/pair_matrix.h"

namespace engine {

/// Of a group's particles, by seat.
struct LaneProduct {
    std::array<double, kGroup> x, y, z;
};

/// Sum over the others of along P (P . d) + across d, where d is what the records' velocities differ by.
void multiplyGroup(const PairMatrix& matrix, std::size_t group, LaneProduct& product);

}  // namespace engine
