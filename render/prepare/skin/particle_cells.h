// Particles sorted into the cells of a grid, so that those near one are found by looking into the cells around it. Used
// for the balls of skins.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Particles whose radius is above 0, sorted by the cells of a grid, component by component, so that all particles in
/// reach of one lie in nine contiguous runs.
struct ParticleCells {
    glm::vec3 low{0.0F};
    float side = 1.0F;
    glm::ivec3 count{1};
    std::vector<std::uint32_t> begin;  ///< sorted index of each cell's first particle; at last the number of particles
    std::vector<float> x, y, z, radius;                 ///< position and radius of each particle, by sorted index
    std::array<std::vector<float>, 3> shift;            ///< m of view.h's anisotropic skin, m; empty in other skins
    std::vector<std::uint32_t> index;                   ///< index of each particle in the view, by sorted index
    float smallestRadius = 0.0F, largestRadius = 0.0F;  ///< of the particles, m

    /// Position and radius of a particle, by sorted index.
    glm::vec4 particle(std::size_t k) const { return {x[k], y[k], z[k], radius[k]}; }
    /// The cell of a point. @pre at is not below `low`; conversion then rounds down (glm::floor may be a call).
    glm::ivec3 cellOf(glm::vec3 at) const { return min(glm::ivec3((at - low) / side), count - 1); }
};

/// Sets the radii, and makes cells as wide as particles influence each other in a smooth skin.
/// @param reach  reach of the field, in radii
void fitToRadii(std::span<const Sphere> particles, float reach, ParticleCells& cells);

/// Sorts the particles whose radius is above 0 into cells.
/// @param reach  reach of the field, in radii
ParticleCells sortIntoCells(std::span<const Sphere> particles, float reach);

}  // namespace render
