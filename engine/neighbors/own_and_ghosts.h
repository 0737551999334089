// The particles that one of many ranks computes pair forces from: its own and the ghosts around them. Kept by
// PairTraversal; not used by a run in one process.
#pragma once

#include <vector>

#include "engine/ranks/halo.h"
#include "engine/state/particles.h"

namespace engine {

/// No particle of this rank, where an index of one is expected.
inline constexpr std::uint32_t kGhost = 0xFFFFFFFF;

struct OwnAndGhosts {
    Halo halo;
    Particles particles;  ///< in combined order; without velocities and times of birth
    /// Own particle index of each sorted index of the neighbor list; kGhost for ghosts.
    std::vector<std::uint32_t> order;
    std::vector<Vec3> velocities;  ///< from which damping and friction are computed, in combined order, m/s
};

/// Finds the ghosts of all ranks, and fetches all that does not change.
/// @param positions  of the first of the rank's particles, m; the others are left out
/// @param reach      distance within which ghosts are needed, m
void findGhosts(const Ranks& ranks, const Particles& own, const std::vector<Vec3>& positions, double reach,
                OwnAndGhosts& all);

/// Fetches the positions (m) and velocities (m/s) of the ghosts that were found last.
void fetchGhosts(const Ranks& ranks, const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities,
                 OwnAndGhosts& all);

}  // namespace engine
