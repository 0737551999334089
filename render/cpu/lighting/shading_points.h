// The points of surfaces that a picture's pixels show, up to a tile's worth at a time. Called by picture_colors.cpp,
// for light_reach.h and shade.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_sample.h"
#include "render/cpu/raster/primary_hits.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/drawn_spheres.h"
#include "render/prepare/tiles.h"

namespace render {

/// All that may be seen, positions relative to the eye in world axes.
struct Surfaces {
    CameraFrame frame;
    std::span<const ViewSphere> spheres;      ///< particles first
    std::span<const SphereAttributes> looks;  ///< of each
    std::int32_t firstObstacle = 0;           ///< index of the first that is none
    std::span<const BoxObstacle> boxes;       ///< in the world
    std::optional<float> ground;              ///< height
    glm::vec3 groundColor{0.0F};
    std::span<const FieldSample> field;
    glm::vec3 toLight{0.0F, 1.0F, 0.0F};
    bool opens = false;  ///< some term of the look asks how open particles are
};

/// Rays and what they see in, points out; a structure of arrays for the lanes.
struct SurfacePoints {
    std::size_t count = 0;
    alignas(64) std::array<std::int32_t, kTilePixels> seen;  ///< as first_hits.h has it
    alignas(64) std::array<float, kTilePixels> x;            ///< of the ray, pixels of the picture
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) std::array<std::array<float, kTilePixels>, 3> position;  ///< relative to the eye, world axes
    alignas(64) std::array<std::array<float, kTilePixels>, 3> normal;
    alignas(64) std::array<float, kTilePixels> depth;  ///< in view; 0 of the background
    alignas(64) std::array<std::array<float, kTilePixels>, 3> albedo;
    /// Of particles: along the normal, against it, along the mirrored ray; where Surfaces::opens.
    alignas(64) std::array<std::array<float, kTilePixels>, 3> open;
};

/// Fills in all but what goes in. The background's normal points away from the light. A ray that misses what it is said
/// to see, by the rounding at an outline, is given the outline.
void placePoints(const Surfaces& surfaces, SurfacePoints& points);

}  // namespace render
