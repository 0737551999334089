// Particles packed for the loops over pairs: all quantities of a particle that the pair forces need lie side by side in
// memory, and the particles are in the order of the neighbor list. Packed by PairTraversal before each pass.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/neighbors/neighbor_list.h"
#include "engine/state/particles.h"

namespace engine {

/// A packed particle in double precision; fills one cache line.
struct alignas(64) PackedParticle {
    double x, y, z;     ///< m
    double vx, vy, vz;  ///< m/s
    double radius;      ///< m
    std::uint32_t material;
    std::uint32_t id;
};

/// A packed particle in single precision. The coordinates are fixed-point numbers modulo 2^32 units, so that
/// differences between the positions of near particles are exact at any distance from the origin.
struct alignas(32) PackedParticleFloat {
    std::int32_t x, y, z;  ///< position, in fixed-point units
    float radius;          ///< m
    float vx, vy, vz;      ///< m/s
    std::uint32_t material;
};

/// Particles packed in single precision, with those that they were packed from, which tell apart particles whose
/// fixed-point coordinates are equal.
struct PackedFloats {
    std::vector<PackedParticleFloat> particles;
    const Particles* source = nullptr;                  ///< must stay unchanged while the packed particles are read
    const std::vector<std::uint32_t>* order = nullptr;  ///< particle index of each packed particle

    bool empty() const { return particles.empty(); }
    void clear() { particles.clear(); }

    /// Whether two particles have the same position.
    bool coincide(std::size_t p, std::size_t i) const {
        return source->position[(*order)[p]] == source->position[(*order)[i]];
    }

    std::uint32_t id(std::size_t p) const { return source->id[(*order)[p]]; }
};

/// Whether two particles have the same position.
inline bool coincide(const PackedParticle& p, const PackedParticle& i) {
    return p.x == i.x && p.y == i.y && p.z == i.z;
}

/// Rounds a coordinate, given in fixed-point units, to an integer modulo 2^32. The result is arbitrary for NaN and
/// beyond 2^83 units.
inline std::int32_t toFixedPoint(double units) {
    // Adding 1.5 x 2^52 to a double rounds it to an integer, which is then found in its last bits. A conversion to an
    // integer type would need a branch for numbers that do not fit.
    constexpr double kRounding = 0x1.8p52;
    constexpr double kModulus = 0x1p32;
    const double turns = (units / kModulus + kRounding) - kRounding;
    const double rest = units - turns * kModulus;  // exact
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(rest + kRounding)));
}

/// Packs all particles in the order of a neighbor list, in double.
/// @param velocities  velocities that damping and friction are computed from, in m/s
void packDoubles(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities,
                 std::vector<PackedParticle>& packed);

/// Packs all particles in the order of a neighbor list, in float.
/// @param velocities  velocities that damping and friction are computed from, in m/s
/// @param unit        length of a fixed-point unit, in meters
void packFloats(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities, double unit,
                PackedFloats& packed);

}  // namespace engine
