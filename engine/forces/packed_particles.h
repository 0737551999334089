// Particles packed for the loops over pairs: what a pair needs of a particle, side by side, in the order of the
// neighbor list. Filled by PairTraversal before each pass.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/neighbors/neighbor_list.h"
#include "engine/state/particles.h"

namespace engine {

/// A particle in double; one cache line.
struct alignas(64) PackedParticle {
    double x, y, z;     ///< m
    double vx, vy, vz;  ///< m/s
    double radius;      ///< m
    std::uint32_t material;
    std::uint32_t id;
};

/// A particle in float. Its coordinates are fixed-point numbers modulo 2^32 units: differences between near particles
/// are exact however far from the origin they are.
struct alignas(32) PackedParticleFloat {
    std::int32_t x, y, z;  ///< units
    std::uint32_t id;
    float vx, vy, vz;       ///< m/s
    std::uint32_t lowBits;  ///< positionBits() of the position in meters
};

/// A mixture of the coordinates' last bits, which tells positions apart that are the same in units.
inline std::uint32_t positionBits(const Vec3& position) {
    const auto lastBits = [](double number) {
        return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number));
    };
    return lastBits(position.x()) ^ std::rotl(lastBits(position.y()), 11) ^ std::rotl(lastBits(position.z()), 22);
}

/// Whether two particles have the same position.
inline bool coincide(const PackedParticle& p, const PackedParticle& i) {
    return p.x == i.x && p.y == i.y && p.z == i.z;
}

/// Whether two particles have the same position, as far as units and last bits tell.
inline bool coincide(const PackedParticleFloat& p, const PackedParticleFloat& i) {
    return p.x == i.x && p.y == i.y && p.z == i.z && p.lowBits == i.lowBits;
}

/// A coordinate in units, rounded to an integer modulo 2^32; an arbitrary integer for NaN and beyond 2^83 units.
inline std::int32_t toFixedPoint(double units) {
    // A sum with 1.5 x 2^52 is rounded to an integer, which stands in its last bits. A conversion instead would need a
    // branch for numbers that do not fit.
    constexpr double kRounding = 0x1.8p52;
    constexpr double kModulus = 0x1p32;
    const double turns = (units / kModulus + kRounding) - kRounding;
    const double rest = units - turns * kModulus;  // exact
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(rest + kRounding)));
}

/// Packs all particles in the order of a list, in double.
/// @param velocities  those that the pass is to see, in m/s
void packDoubles(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities,
                 std::vector<PackedParticle>& packed);

/// Packs all particles in the order of a list, in float.
/// @param velocities  those that the pass is to see, in m/s
/// @param unit        of the fixed-point coordinates, in meters
void packFloats(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities, double unit,
                std::vector<PackedParticleFloat>& packed);

}  // namespace engine
