// How much of the sky each point of a scene sees (ambient occlusion), from the density of particles on a grid: section
// 3 of shading_model.h defines it. Called by the picture pass when a term of the shading model needs it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// The values O of shading_model.h along +x, -x, +y, -y, +z, -z: 0 is hidden, 1 is open.
using SkyVisibility = std::array<float, 6>;

inline constexpr SkyVisibility kUnoccluded = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// The values O at the centers of the grid's cubes, x fastest. Empty for a view without particles.
struct SkyVisibilityGrid {
    glm::vec3 origin{0.0F};                    ///< center of the first cube, world coordinates
    float side = 1.0F;                         ///< of a cube, m
    glm::ivec3 cells{0};                       ///< cubes along each axis
    std::array<std::vector<float>, 6> values;  ///< in the order of SkyVisibility
};

/// The values along +y at one height, for the ground: row by row, x fastest.
struct SkyVisibilityMap {
    glm::vec2 origin{0.0F};  ///< x and z of the first cell's center, world coordinates
    float side = 1.0F;       ///< of a cell, m
    int columns = 0;         ///< cells along x
    int rows = 0;            ///< cells along z
    std::vector<float> values;
};

/// The result depends on the particles alone, bit for bit, not on the number of threads.
/// @param old  a grid that is no longer needed, whose memory is reused
SkyVisibilityGrid skyVisibilityGrid(std::span<const Sphere> particles, SkyVisibilityGrid old = {});

/// How far from a point, in sides of a cube, the grid is sampled along the direction asked for (0.75 in
/// shading_model.h).
inline constexpr float kSkySampleOffset = 0.75F;

/// The values at each particle's center; kUnoccluded outside of the grid. They depend on the center and the grid alone,
/// bit for bit, not on the instruction set.
std::vector<SkyVisibility> particleSkyVisibility(std::span<const Sphere> particles, const SkyVisibilityGrid& grid);

/// @param height  y of the ground, world coordinates, m
SkyVisibilityMap skyVisibilityAtHeight(const SkyVisibilityGrid& grid, float height);

}  // namespace render
