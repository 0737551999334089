// Particles as the kernels over pairs read them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "engine/forces/packed_particle.h"
#include "engine/neighbors/neighbor_list.h"
#include "engine/state/particles.h"

namespace engine {

/// Pointers, for loops to have at hand: what they write might be block of a vector, for all a compiler knows, which
/// then looks for its numbers anew.
struct SortedParticles {
    const std::uint32_t* order;  ///< particle index at each sortedIndex
    std::size_t count;
    const std::uint32_t* id;  ///< of each particle index, as what follows
    const Vec3* position;     ///< m
    const Vec3* velocity;     ///< m/s
    const double* radius;     ///< m
    const std::uint32_t* material;

    SortedParticles(const NeighborList& list, const Particles& particles, const std::vector<Vec3>& velocities)
        : order(list.order.data()),
          count(list.count()),
          id(particles.id.data()),
          position(particles.position.data()),
          velocity(velocities.data()),
          radius(particles.radius.data()),
          material(particles.material.data()) {}
};

/// A sum with 1.5 x 2^52 is rounded to a whole number that stands in its last bits: no conversion, which would need a
/// branch for what does not fit.
inline constexpr double kWholeRounding = 0x1.8p52;

/// How many numbers 32 bits tell apart.
inline constexpr double kWordTurn = 0x1p32;

/// Rounded to a whole number, modulo 2^32; some number for what is no number or beyond all worlds.
inline std::int32_t toFixedPoint(double units) {
    const double turns = (units / kWordTurn + kWholeRounding) - kWholeRounding;
    const double rest = units - turns * kWordTurn;  // exact
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(rest + kWholeRounding)));
}

/// The record of one particle in double.
inline PackedParticle packDouble(const SortedParticles& from, std::size_t p) {
    const Vec3& x = from.position[p];
    const Vec3& v = from.velocity[p];
    return {x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), from.radius[p], from.material[p], from.id[p]};
}

/// The record of one particle in float: the plain twin of packFloats. Shape: position in m, velocity in m/s; units in
/// a meter.
inline PackedParticleFloat packFloat(const Vec3& position, const Vec3& velocity, std::uint32_t id, double perMeter) {
    const Vec3 units = position * perMeter;
    return {toFixedPoint(units.x()),          toFixedPoint(units.y()),
            toFixedPoint(units.z()),          id,
            static_cast<float>(velocity.x()), static_cast<float>(velocity.y()),
            static_cast<float>(velocity.z()), lowBits(position.x(), position.y(), position.z())};
}

/// Writes the packed of the sortedIndices from begin to end to where they belong among all.
void packDoubles(const SortedParticles& from, std::size_t begin, std::size_t end, PackedParticle* all);

/// The same in float. Shape: perMeter: as above.
/// Holds:  equal to packFloat's on any instruction set.
void packFloats(const SortedParticles& from, double perMeter, std::size_t begin, std::size_t end,
                PackedParticleFloat* all);

}  // namespace engine
