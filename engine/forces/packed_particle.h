// A particle as the kernels over pairs read it.
#pragma once

#include <bit>
#include <cstdint>

namespace engine {

/// In double, in the order of a neighbor list; one cache line.
struct alignas(64) PackedParticle {
    double x, y, z;     ///< m
    double vx, vy, vz;  ///< m/s
    double radius;      ///< m
    std::uint32_t material;
    std::uint32_t id;
};

/// In float. Positions are whole numbers of a unit, modulo 2^32: what near particles differ by is exact however far
/// from the origin they are.
struct alignas(32) PackedParticleFloat {
    std::int32_t x, y, z;
    std::uint32_t id;
    float vx, vy, vz;    ///< m/s
    std::uint32_t rest;  ///< lowBits() the position
};

/// Tells positions apart that are the same in units: a mixture of their last bits.
inline std::uint32_t lowBits(double x, double y, double z) {
    const auto lastBits = [](double number) {
        return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number));
    };
    return lastBits(x) ^ std::rotl(lastBits(y), 11) ^ std::rotl(lastBits(z), 22);
}

/// Whether two share their exact position.
inline bool coincide(const PackedParticle& p, const PackedParticle& i) {
    return p.x == i.x && p.y == i.y && p.z == i.z;
}

/// The same as far as the packed tell.
inline bool coincide(const PackedParticleFloat& p, const PackedParticleFloat& i) {
    return p.x == i.x && p.y == i.y && p.z == i.z && p.rest == i.rest;
}

}  // namespace engine
