// The view from the light: a plane spanned by u and v, heights toward the light. Spheres that cast shadows are binned
// to a grid on that plane, so that a shaded point walks only what may stand between it and the light. Positions
// relative to the eye.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/prepare/tiles.h"

namespace render {

/// Right-handed and orthonormal: u, v, and toward the light.
struct LightBasis {
    glm::vec3 u{1.0F, 0.0F, 0.0F};
    glm::vec3 v{0.0F, 0.0F, 1.0F};
    glm::vec3 toLight{0.0F, 1.0F, 0.0F};

    glm::vec3 toLightSpace(glm::vec3 point) const { return {dot(point, u), dot(point, v), dot(point, toLight)}; }
};

LightBasis lightBasis(glm::vec3 toLight);

/// Spheres that cast shadows, side by side for the lanes.
struct LightSpheres {
    std::vector<float> u, v, height, radius;
};

/// Begin and end of a cell's list.
struct ListRange {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

struct LightGrid {
    glm::vec2 origin{0.0F};
    float cellSize = 1.0F;
    int columns = 1;
    int rows = 1;
    std::vector<ListRange> cells;
    /// Cell after cell, the nearest to the light first; behind the last as many more as a vector holds.
    LightSpheres spheres;

    bool empty() const { return spheres.u.empty(); }
};

/// Bins spheres (center relative to the eye) for a light whose shadows are this soft.
LightGrid lightGrid(const LightBasis& basis, std::span<const ViewSphere> spheres, float softness);

/// Bounds of spheres on the light's plane and along it.
struct LightBounds {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};
};

LightBounds lightBounds(const LightBasis& basis, std::span<const ViewSphere> spheres);

}  // namespace render
