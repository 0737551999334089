// The light of glowing particles on what is around them, on a grid of cubes: glowLight of shading_model.h, section 3.
// Called by the preparation of a view whose particles glow.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Irradiance at the centers of a grid's cubes. Empty for a view without particles that glow.
struct GlowGrid {
    glm::vec3 origin{0.0F};  ///< center of the first cube, world coordinates, m
    float side = 1.0F;       ///< side of a cube, m
    glm::ivec3 cells{0};     ///< number of cubes along each axis
    /// Linear RGB on surfaces that face +x, -x, +y, -y, +z, -z: six of each cube, one after another, cubes x fastest.
    std::vector<glm::vec4> values;

    /// Index of a cube, for its column, row and layer.
    std::size_t cellIndex(int x, int y, int z) const {
        const auto row = static_cast<std::size_t>(cells.x);
        return static_cast<std::size_t>(x) +
               row * (static_cast<std::size_t>(y) + static_cast<std::size_t>(cells.y) * static_cast<std::size_t>(z));
    }
    bool empty() const { return values.empty(); }
};

/// Gathers the light of the particles. The result depends on the particles alone, bit for bit, not on the number of
/// threads.
/// @param glow     strength of the particles' light, as in Surface
/// @param sky      sky visibility of each particle along +x, -x, +y, -y, +z, -z
/// @param skySide  side of a cube of the grid that the sky visibility comes from, m
GlowGrid glowGrid(std::span<const Sphere> particles, float glow, std::span<const std::array<float, 6>> sky,
                  float skySide);

}  // namespace render
