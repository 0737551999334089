// A particle as the kernels over pairs read it.
#pragma once

#include <cstdint>

namespace engine {

/// In double, in the order of a neighbour list; one cache line.
struct alignas(64) PairRecord {
    double x, y, z;     ///< m
    double vx, vy, vz;  ///< m/s
    double radius;      ///< m
    std::uint32_t material;
    std::uint32_t id;
};

/// In float. Positions are whole numbers of a unit, modulo 2^32: what near particles differ by is exact however far
/// from the origin they are.
struct alignas(32) SinglePrecisionRecord {
    std::int32_t x, y, z, unusedPosition;
    float vx, vy, vz, unusedVelocity;  ///< m/s
};

}  // namespace engine
