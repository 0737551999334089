// How much of the sky each point of a scene sees (ambient occlusion), from the density of particles on a grid: section
// 3 of shading_model.h defines it. Called by the preparation of a view when a term of the shading model needs it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Sky visibility at a point along +x, -x, +y, -y, +z, -z: the values O of shading_model.h. 0 is hidden, 1 is open.
using SkyVisibility = std::array<float, 6>;

inline constexpr SkyVisibility kUnoccluded = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// Sky visibility at the centers of a grid's cubes, x fastest. Empty for a view without particles.
struct SkyVisibilityGrid {
    glm::vec3 origin{0.0F};                    ///< center of the first cube, world coordinates, m
    float side = 1.0F;                         ///< side of a cube, m
    glm::ivec3 cells{0};                       ///< number of cubes along each axis
    std::array<std::vector<float>, 6> values;  ///< one list for each direction, as in SkyVisibility
};

/// Sky visibility along +y at the height of the ground: row by row, x fastest.
struct SkyVisibilityMap {
    glm::vec2 origin{0.0F};  ///< x and z of the first cell's center, world coordinates, m
    float side = 1.0F;       ///< side of a cell, m
    int columns = 0;         ///< number of cells along x
    int rows = 0;            ///< number of cells along z
    std::vector<float> values;
};

/// Computes the sky visibility around the particles. The result depends on the particles alone, bit for bit, not on the
/// number of threads.
/// @param old  a grid that is no longer needed, whose memory is reused
SkyVisibilityGrid skyVisibilityGrid(std::span<const Sphere> particles, SkyVisibilityGrid old = {});

/// How far from a point, in sides of a cube, the grid is sampled along the direction asked for (0.75 in
/// shading_model.h).
inline constexpr float kSkySampleOffset = 0.75F;

/// Sky visibility at the center of each particle; kUnoccluded outside of the grid. It depends on the center and the
/// grid alone, bit for bit, not on the instruction set.
std::vector<SkyVisibility> particleSkyVisibility(std::span<const Sphere> particles, const SkyVisibilityGrid& grid);

/// Sky visibility of the ground.
/// @param height  y of the ground, world coordinates, m
SkyVisibilityMap skyVisibilityAtHeight(const SkyVisibilityGrid& grid, float height);

}  // namespace render
