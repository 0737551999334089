// Particles as the kernels over pairs read them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "engine/ordered_particles.h"
#include "engine/pair_record.h"

namespace engine {

/// A sum with 1.5 x 2^52 is rounded to a whole number that stands in its last bits: no conversion, which would need a
/// branch for what does not fit.
inline constexpr double kWholeRounding = 0x1.8p52;

/// How many numbers 32 bits tell apart.
inline constexpr double kWordTurn = 0x1p32;

/// Rounded to a whole number, modulo 2^32; some number for what is no number or beyond all worlds.
inline std::int32_t wrappedUnits(double units) {
    const double turns = (units / kWordTurn + kWholeRounding) - kWholeRounding;
    const double rest = units - turns * kWordTurn;  // exact
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(rest + kWholeRounding)));
}

/// The record of one particle in double.
inline PairRecord doubleRecord(const OrderedParticles& from, std::size_t p) {
    const Vec3& x = from.position[p];
    const Vec3& v = from.velocity[p];
    return {x.x(), x.y(), x.z(), v.x(), v.y(), v.z(), from.radius[p], from.material[p], from.id[p]};
}

/// The record of one particle in float: the plain twin of makeSingles. Shape: position in m, velocity in m/s; units in
/// a metre.
inline SinglePrecisionRecord singleRecord(const Vec3& position, const Vec3& velocity, std::uint32_t id,
                                          double perMetre) {
    const Vec3 units = position * perMetre;
    return {wrappedUnits(units.x()),          wrappedUnits(units.y()),
            wrappedUnits(units.z()),          id,
            static_cast<float>(velocity.x()), static_cast<float>(velocity.y()),
            static_cast<float>(velocity.z()), restOf(position.x(), position.y(), position.z())};
}

/// Writes the records of the places from begin to end to where they belong among all.
void makeDoubles(const OrderedParticles& from, std::size_t begin, std::size_t end, PairRecord* all);

/// The same in float. Shape: perMetre: as above.
/// Holds:  equal to singleRecord's on any instruction set.
void makeSingles(const OrderedParticles& from, double perMetre, std::size_t begin, std::size_t end,
                 SinglePrecisionRecord* all);

}  // namespace engine
