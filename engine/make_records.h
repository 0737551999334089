// Particles as the kernels over pairs, and the search for them, read them.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "engine/lane_rows.h"
#include "engine/list_search.h"
#include "engine/ordered_particles.h"
#include "engine/pair_record.h"
#include "engine/parallel.h"

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

/// The record of one particle in double: the plain twin of makeDoubles.
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

/// For whom something is written.
enum class Readers {
    writer,  ///< mostly who writes it
    all,     ///< all threads, once they are told of it: to memory, past the caches
};

/// Calls write(places, readers) for 0 ... count - 1, shared out over the threads.
/// Where one thread writes again what others have read, it waits, line by line, for their caches to give it up.
/// Measured with `globular bench --filter symplectic` on Zen 5: a tenth of a step of 1000 settled particles, an eighth
/// of one of 2000, a sixth of one of 2000 grains of powder.
template <class Write>
void forPlaces(std::size_t count, const Write& write) {
    const bool hasOneWriter = count <= kParticleGrain;                   // inRanges makes one range of them
    const bool hasReaders = count > kSeatsPerPart && threadCount() > 1;  // chosen: below, there is little to wait for
    const Readers readers = hasOneWriter && hasReaders ? Readers::all : Readers::writer;
    inRanges(count, kParticleGrain, [&](std::size_t begin, std::size_t end) {
        write(CellRange{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)}, readers);
    });
}

/// Writes the records of some places to where they belong among all.
/// Holds:  equal to doubleRecord's on any instruction set.
void makeDoubles(const OrderedParticles& from, const CellRange& places, Readers readers, PairRecord* all);

/// The same in float. Shape: perMetre: as above. Holds:  equal to singleRecord's on any instruction set.
void makeSingles(const OrderedParticles& from, double perMetre, const CellRange& places, Readers readers,
                 SinglePrecisionRecord* all);

/// Writes the positions (m) of the particles in some places for a search; leaves the overhang alone. Shape: positions
/// by particle index; order: particle index at each place. Holds:  the positions themselves, on any instruction set.
void makeCandidates(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& order,
                    const CellRange& places, Readers readers, Candidates& all);

}  // namespace engine
