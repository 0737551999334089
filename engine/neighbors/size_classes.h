// Particles by size. The cells of a grid are as wide as the cutoff of its largest particles. Where radii differ much,
// such cells hold thousands of small particles, so particles of similar size get a grid of their own. Called by
// neighbor_list.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/vec3.h"
#include "engine/neighbors/cell_grid.h"
#include "engine/ranks/ranks.h"

namespace engine {

/// The sizes of the particles of all ranks.
struct SizeTable {
    /// The particles whose radius can be doubled equally often without exceeding the largest radius.
    struct Class {
        double largestRadius = 0.0;  ///< m; 0 without particles
        std::uint64_t count = 0;     ///< not counted where there is a single class
    };
    std::vector<Class> classes{1};  ///< by number of doublings; one for all if all are of similar size
    bool areEqual = true;           ///< whether all radii are equal

    double largestRadius() const { return classes.front().largestRadius; }
    bool areSimilar() const { return classes.size() == 1; }
};

/// Tabulates radii (m), each above 0.
SizeTable sizesOf(const Ranks& ranks, std::span<const double> radii);

/// The largest radius in the class that has the most particles, divided by the largest radius of all; 1 for no radii.
double typicalRelativeRadius(const SizeTable& sizes);

/// Particles whose radii differ by a factor below 2, and their cell grid.
struct SizeClass {
    double relativeRadius = 1.0;         ///< largest radius in the class, divided by the largest of all particles
    CellRange sorted;                    ///< sorted indices of the class' particles in the neighbor list
    std::vector<std::uint32_t> members;  ///< particle indices, ascending; empty if all particles are of similar size
    CellGrid grid;                       ///< the cell grid of the members, which counts them from 0
};

/// Divides particles into classes, those with the largest particles first. Particles that are all of similar size make
/// one class.
/// @param radii    of the particles, m; not used if all are of similar size
/// @param count    number of particles
/// @param classes  receives the classes, without the grids' contents; memory of earlier calls is used again
void divideBySize(const SizeTable& sizes, std::span<const double> radii, std::size_t count,
                  std::vector<SizeClass>& classes);

/// Sorts the particles of a class into its grid. Positions (m) are by particle index.
void buildGrid(SizeClass& sizeClass, const std::vector<Vec3>& positions, double cellWidth);

}  // namespace engine
