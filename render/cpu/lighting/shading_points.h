// Shading points (a G-buffer): position, normal and material of what rays hit, up to a tile's worth at a time. Filled
// for picture_colors.cpp, read by light_visibility.cpp and shade.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/cpu/raster/primary_hits.h"
#include "render/picture/camera_frame.h"
#include "render/picture/drawn_meshes.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/drawn_spheres.h"

namespace render {

/// Everything that a ray may hit, with its material; positions relative to the eye along the world's axes.
struct ShadingGeometry {
    CameraFrame frame;
    std::span<const ViewSphere> spheres;           ///< particles, then sphere obstacles
    std::span<const SphereAttributes> attributes;  ///< color and sky visibility of each sphere
    std::int32_t firstObstacle = 0;                ///< index of the first sphere that is no particle
    std::span<const BoxObstacle> boxes;            ///< boxes, in world coordinates
    std::optional<float> ground;                   ///< height of the ground, m
    glm::vec3 groundColor{0.0F};
    std::span<const PackedHit> metaballs;  ///< hits of all rays that met metaballs
    glm::vec3 toLight{0.0F, 1.0F, 0.0F};
    bool hasSky = false;  ///< whether some term of the shading model needs the particles' sky visibility
    const DrawnMeshes* meshes = nullptr;  ///< null without meshes
};

/// Up to a tile's worth of shading points as a structure of arrays. The caller sets count, hitId, x and y;
/// evaluateShadingPoints() sets the others.
struct ShadingPoints {
    std::size_t count = 0;
    alignas(64) std::array<std::int32_t, kTilePixels> hitId;  ///< what each ray hits, see primary_hits.h
    alignas(64) std::array<float, kTilePixels> x;             ///< positions of the rays on the picture, pixels
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) TileVec3 position;  ///< position of the point relative to the eye, along the world's axes, m
    alignas(64) TileVec3 normal;
    alignas(64) std::array<float, kTilePixels> depth;  ///< view depth, m; 0 for the background
    alignas(64) TileVec3 albedo;
    /// Sky visibility of particles along the normal, against it and along the mirrored ray; only with
    /// ShadingGeometry::hasSky.
    alignas(64) TileVec3 sky;
};

/// Intersects each ray with the one thing that primary_hits.cpp found it to hit. That search keeps only the identity of
/// a hit and its depth, because most hits are never shaded. A ray at an outline that misses by rounding, and one beside
/// a triangle that other samples of its pixel hit, gets a point of the outline. The background's normal points away
/// from the light.
void evaluateShadingPoints(const ShadingGeometry& geometry, ShadingPoints& points);

}  // namespace render
