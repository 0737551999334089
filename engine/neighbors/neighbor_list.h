// The neighbor list: for every particle, all other particles within the cutoff plus a skin. A list stays valid until a
// particle has moved by half the skin relative to the motion that all particles have in common. Most time steps
// therefore need no new list, and particles that fall freely together never do. Kept by PairTraversal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/scratch.h"
#include "engine/neighbors/cell_grid.h"
#include "engine/neighbors/far_groups.h"
#include "engine/neighbors/list_search.h"
#include "engine/neighbors/neighbor_rows.h"
#include "engine/neighbors/size_classes.h"

namespace engine {

/// Work memory for building a neighbor list.
struct BuildScratch {
    std::vector<SizeClass> classes;  ///< largest particles first; a single class' order belongs to an earlier list
    std::span<const std::uint8_t> isGhost;  ///< by particle index, during build(); empty if none is
    Candidates candidates;
};

/// A neighbor list, in which every particle has two numbers. The sorted index is the particle's rank in the order of
/// the grid cells, those of large particles first. The lane slot is the number of the particle's row. Both lie in the
/// same block; within a block the longest rows come first, so that the rows of a cluster of SIMD lanes have similar
/// lengths.
struct NeighborList {
    std::vector<std::uint32_t> order;          ///< particle index of each sorted index
    std::vector<std::uint32_t> sortedIndexOf;  ///< sorted index of each particle index
    NeighborRows rows;                         ///< neighbors of the particle in each lane slot
    std::size_t entryCount = 0;                ///< sum of the lengths of all rows
    std::vector<Vec3> builtAt;                 ///< positions by particle index when the list was built, m; see build()
    double cutoff = 0.0;                       ///< cutoff of the largest particles, m
    double skin = 0.0;                         ///< m
    Scratch<BuildScratch> scratch;

    std::size_t count() const { return order.size(); }

    /// Largest distance at which a pair may be listed, m.
    double reach() const { return cutoff + skin; }

    /// Lane slot of the particle with this index, found by searching the particle's block.
    std::size_t laneSlotOf(std::size_t p) const;
};

/// Builds the neighbor list for these positions (m). The result is the same for any number of threads and any
/// instruction set.
/// @param radii   of the particles, m; pairs act up to a distance of `cutoff` times the sum of their radii over twice
/// the
///                largest radius. Empty for equal ones: all pairs act up to `cutoff`.
/// @param cutoff  of the largest particles, m, at least 0
/// @param skin    in meters, at least 0
void build(NeighborList& list, const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff,
           double skin);

/// Builds the list of one of many ranks: its own particles and ghosts, particles of other ranks, together in ascending
/// order of their ids. Ghosts are neighbors, but get empty rows. The rows of the rank's own particles have the same
/// neighbors in the same order as in the list of a run in one process, except for neighbors so far away that float may
/// list them or not. To use covers(), the caller then restricts builtAt to the rank's own particles.
/// @param sizes    of the particles of all ranks
/// @param isGhost  by particle index, 0 or 1; empty if none is a ghost
void build(NeighborList& list, const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff,
           double skin, const SizeTable& sizes, std::span<const std::uint8_t> isGhost);

/// Empties a list. It then covers no particles.
void discard(NeighborList& list);

/// Whether a neighbor list certainly contains every pair of particles that act on each other at these positions (m).
/// @param cutoff  of the largest particles, m
/// @param groups  groups each of which may have moved as a whole, if they are farther apart than the cutoff
/// @param ranks   the answer is for all of them: whether each one's list covers its positions
bool covers(const NeighborList& list, const std::vector<Vec3>& positions, double cutoff, const FarGroups& groups = {},
            const Ranks& ranks = Ranks::alone());

/// Skin, as a share of the cutoff, for use where the speed of the particles is not known. Chosen: about the best for a
/// liquid.
inline constexpr double kDefaultSkin = 0.1;

/// The skin, in cutoffs, at which building neighbor lists and computing forces from them together cost least per time
/// step. With a wide skin a list stays valid for many steps, with a narrow skin its rows are short.
/// @param neighbors     mean number of neighbors within the cutoff
/// @param displacement  displacement of the fastest particle in a step, in cutoffs
double optimalSkin(double neighbors, double displacement);

/// Number of entries for which neighbor rows have room, padding included.
std::size_t roomOf(const NeighborRows& rows);

/// Bytes of memory that neighbor rows hold.
std::size_t bytesOf(const NeighborRows& rows);

/// Bytes of memory that a neighbor list holds, including the work memory for building it.
std::size_t bytesOf(const NeighborList& list);

}  // namespace engine
