// How open to the sky the places of a scene are, from a grid of how full of particles space is; view.h defines it.
// Called by the picture pass when a look asks for it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Openness along +x, -x, +y, -y, +z, -z; 1 is open.
using SkyVisibility = std::array<float, 6>;

inline constexpr SkyVisibility kUnoccluded = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// Values at the middles of cubes, x fastest; empty without particles.
struct SkyVisibilityGrid {
    glm::vec3 origin{0.0F};  ///< middle of the first cube, world
    float side = 1.0F;       ///< m
    glm::ivec3 cells{0};
    std::array<std::vector<float>, 6> values;

    std::size_t cellIndex(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(cells.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(cells.x) +
               static_cast<std::size_t>(x);
    }
};

/// A slice of the grid at one height, along +y: what the ground receives.
struct SkyVisibilityMap {
    glm::vec2 origin{0.0F};  ///< middle of the first cell, x and z
    float side = 1.0F;
    int columns = 0;
    int rows = 0;
    std::vector<float> values;
};

/// old: one that is no longer used, whose memory is taken.
/// Holds:  the result depends on the view's particles alone, bit for bit, not on the number of threads.
SkyVisibilityGrid skyVisibilityGrid(std::span<const Sphere> particles, SkyVisibilityGrid old = {});

/// Sides of a cube that a place is moved along the direction it looks in.
inline constexpr float kSkySampleOffset = 0.75F;

/// At each particle's center; kOpen outside of the grid.
/// Holds:  a particle's values depend on its center and the grid alone, bit for bit, not on the number of lanes.
std::vector<SkyVisibility> particleSkyVisibility(std::span<const Sphere> particles, const SkyVisibilityGrid& grid);

SkyVisibilityMap skyVisibilityAtHeight(const SkyVisibilityGrid& grid, float height);

}  // namespace render
