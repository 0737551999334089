// Particles sorted into cells as wide as the longest reach, number by number, so that whoever is in reach of a
// particle stands in nine runs. Called by skin.cpp; crowd_sums.cpp reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Particles that lanes take at a time. The vectors below hold so many numbers more than there are particles, so that
/// whole blocks can be read from any place.
inline constexpr std::size_t kDensityBlock = 16;

struct SkinCells {
    glm::vec3 low{0.0F};
    float side = 1.0F;
    glm::ivec3 count{1};
    std::vector<std::uint32_t> begin;    ///< place of each cell's first particle, and the end
    std::vector<float> x, y, z, radius;  ///< of the particle at each place; kCrowdBlock more
    std::vector<std::uint32_t> index;    ///< of the particle at each place

    /// at: not below `low`, so that conversion rounds down; glm::floor may be a call.
    glm::ivec3 cellOf(glm::vec3 at) const { return min(glm::ivec3((at - low) / side), count - 1); }

    std::size_t cellIndex(int column, int row, int slice) const {
        return (static_cast<std::size_t>(slice) * static_cast<std::size_t>(count.y) + static_cast<std::size_t>(row)) *
                   static_cast<std::size_t>(count.x) +
               static_cast<std::size_t>(column);
    }
};

/// reach: of the field, in radii. Cells are wider where there would be too many.
SkinCells skinCells(std::span<const Sphere> particles, float reach);

}  // namespace render
