// Light space: coordinates u and v on a plane across the direction of the light, and a height toward the light. Spheres
// and boxes that cast shadows are binned into grids on that plane, so that a shaded point tests only those between it
// and the light. All positions are relative to the eye. Called by the preparation of a view; the basis also serves the
// metaballs' depth map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"

namespace render {

/// The right-handed orthonormal basis of light space, in world axes.
struct LightBasis {
    glm::vec3 u{1.0F, 0.0F, 0.0F};
    glm::vec3 v{0.0F, 0.0F, 1.0F};
    glm::vec3 toLight{0.0F, 1.0F, 0.0F};

    glm::vec3 toLightSpace(glm::vec3 point) const { return {dot(point, u), dot(point, v), dot(point, toLight)}; }

    bool operator==(const LightBasis&) const = default;
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

/// Boxes in light space, component by component as vector loads need them.
struct LightBoxes {
    std::vector<std::uint32_t> index;             ///< index of the box
    std::vector<float> lowU, highU, lowV, highV;  ///< bounds on the light's plane, m; a little wider for the rounding
    std::vector<float> top;                       ///< greatest height, m; a little more for the rounding
};

/// Boxes that cast shadows, listed for the cells of a grid on the light's plane. A point beyond the grid belongs to the
/// nearest cell, so that a few boxes far away from the others do not make its cells larger.
struct LightBoxGrid {
    glm::vec2 origin{0.0F};  ///< u and v of the first cell's corner, m
    float cellSize = 1.0F;   ///< side of a cell, m
    int columns = 1;
    int rows = 1;
    /// The list of a cell has all boxes whose shadows reach into it where a pixel is no wider than this, m. Where
    /// pixels are wider, so are the edges of shadows: points there use the list of all boxes.
    float widestPixel = 0.0F;
    /// 1 / components of the direction toward the light; where one is nearly 0, of 1e-6 instead.
    glm::vec3 inverse{1.0F};
    /// 1 / lengths of the gradients of box_shadows-inl.h for the axes x and y, y and z, z and x.
    glm::vec3 gapScale{1.0F};
    /// How far an edge reaches beyond the bounds of its box along u and v, in widths of the edge.
    glm::vec2 edgeReach{0.0F};
    /// Cell c lists the boxes begin[c] ... begin[c + 1] - 1 in the order of their indices. Cells are row by row; the
    /// last list has all boxes.
    std::vector<std::uint32_t> begin{0, 0, 0};
    /// One list for each cell, one after another. At least as many unused entries as a vector has lanes follow.
    LightBoxes boxes;

    /// Whether there are so few boxes that testing all takes less time than finding out which are near. Measured.
    bool isFew() const { return begin.back() - begin[listOfAll()] <= 2; }
    std::size_t listOfAll() const { return begin.size() - 2; }
};

/// Lists the boxes that cast shadows.
/// @param boxes      in world coordinates
/// @param softWidth  greatest width of the soft edge of a box's shadow, m
LightBoxGrid lightBoxGrid(const LightBasis& basis, const CameraFrame& frame, std::span<const BoxObstacle> boxes,
                          float softWidth);

}  // namespace render
