// What the particles around others add up to, as many at a time as the machine has lanes. Called by skin.cpp.
#pragma once

#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "render/prepare/skin_cells.h"

namespace render {

/// With k = max(0, 1 - d^2 / reach^2)^2 of each particle in reach, which is so many mean radii of both.
struct DensitySum {
    float density = 0.0F;            ///< sum of k, the particle itself included
    glm::vec3 weightedOffset{0.0F};  ///< sum of k times the way there
};

/// Of the particles at places first, first + 1, ... of the cells.
/// Holds:  the same bits on every instruction set.
void densitySums(const SkinCells& cells, float reach, std::size_t first, std::span<DensitySum> sums);

}  // namespace render
