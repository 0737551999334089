// Light space: coordinates u and v on a plane across the direction of the light, and a height toward the light. Spheres
// that cast shadows are binned into a grid on that plane, so that a shaded point tests only those between it and the
// light. All positions are relative to the eye. Called by the preparation of a view; the basis also serves the
// metaballs' depth map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/prepare/tiles.h"

namespace render {

/// The right-handed orthonormal basis of light space, in world axes.
struct LightBasis {
    glm::vec3 u{1.0F, 0.0F, 0.0F};
    glm::vec3 v{0.0F, 0.0F, 1.0F};
    glm::vec3 toLight{0.0F, 1.0F, 0.0F};

    glm::vec3 toLightSpace(glm::vec3 point) const { return {dot(point, u), dot(point, v), dot(point, toLight)}; }
};

/// The basis of light space.
/// @param toLight  vector toward the light, of any length but 0
LightBasis lightBasis(glm::vec3 toLight);

/// Spheres in light space, component by component as vector loads need them.
struct LightSpheres {
    std::vector<float> u, v, height, radius;
};

/// Spheres that cast shadows, listed for the cells of a grid on the light's plane.
struct LightGrid {
    glm::vec2 origin{0.0F};  ///< u and v of the first cell's corner, m
    float cellSize = 1.0F;   ///< side of a cell, m
    int columns = 1;
    int rows = 1;
    /// Cell c lists the spheres begin[c] ... begin[c + 1] - 1. Cells are row by row.
    std::vector<std::uint32_t> begin{0, 0};
    /// One list for each cell, one after another. The spheres that reach highest toward the light come first. At least
    /// as many unused entries as a vector has lanes follow the last sphere.
    LightSpheres spheres;

    bool empty() const { return spheres.u.empty(); }
};

/// Lists the spheres that cast shadows.
/// @param spheres  in world axes, relative to the eye; their radii are above zero
/// @param softness  softness of the light; a sphere is listed in all cells that the soft edge of its shadow reaches
LightGrid lightGrid(const LightBasis& basis, std::span<const ViewSphere> spheres, float softness);

}  // namespace render
