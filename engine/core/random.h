// Random numbers as pure functions of a key. No state has to be stored when a run is interrupted, and the numbers are
// the same on every machine. Used for jitter, for the choice among emission sites and for the direction in which
// coincident particles are separated.
#pragma once

#include <cstdint>

#include "engine/core/vec3.h"

namespace engine {

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): a bijection that scatters neighboring keys.
inline std::uint64_t scatter(std::uint64_t key) {
    key += 0x9E3779B97F4A7C15ULL;
    key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9ULL;
    key = (key ^ (key >> 27)) * 0x94D049BB133111EBULL;
    return key ^ (key >> 31);
}

/// Random bits for a seed and two counters.
inline std::uint64_t randomBits(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
    return scatter(scatter(scatter(seed) ^ stream) ^ index);
}

/// A random number in [-1, 1) made from the upper 53 of 64 random bits, without rounding.
inline double symmetricUnit(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1.0p-52 - 1.0;
}

/// A random vector for a seed and a counter; each component is in [-1, 1).
inline Vec3 randomVector(std::uint64_t seed, std::uint64_t stream) {
    return {symmetricUnit(randomBits(seed, stream, 0)), symmetricUnit(randomBits(seed, stream, 1)),
            symmetricUnit(randomBits(seed, stream, 2))};
}

}  // namespace engine
