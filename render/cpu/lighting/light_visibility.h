// How much of the light and of the sky reaches the points that a picture shows; view.h defines both. Called by
// picture_colors.cpp for tiles where anything may dim them.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/light_space.h"

namespace render {

/// All that stands in the light's way, and how open the places of the scene are.
struct Obstruction {
    LightBasis light;
    glm::vec3 eye{0.0F};
    const LightGrid* spheres = nullptr;  ///< null where no sphere casts a shadow
    const DepthMap* field = nullptr;     ///< null where no metaballs do
    std::span<const BoxObstacle> boxes;  ///< that cast shadows
    float softness = 0.0F;
    float meanRadius = 0.0F;                   ///< of the particles
    const SkyVisibilityGrid* open = nullptr;   ///< null where the look does not ask for occlusion
    const SkyVisibilityMap* ground = nullptr;  ///< likewise
};

/// Shares for each point.
struct LightReach {
    alignas(64) std::array<float, kTilePixels> light;  ///< none in shadow or turned away from the light
    alignas(64) std::array<float, kTilePixels> sky;    ///< 1 on particles, which bring their openness along
};

/// Holds:  a point's values depend on the point alone, bit for bit, not on the number of lanes.
void reach(const Obstruction& obstruction, const Surfaces& surfaces, const SurfacePoints& points, LightReach& reach);

}  // namespace render
