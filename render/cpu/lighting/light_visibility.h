// How much of the light and of the sky reaches shading points, by the definitions of shading_model.h. Called by
// picture_colors.cpp for tiles where anything may cast a shadow or occlude the sky.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/cpu/lighting/depth_map.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/picture/view.h"
#include "render/prepare/lighting/ambient_occlusion.h"
#include "render/prepare/lighting/glow_light.h"
#include "render/prepare/lighting/light_space.h"
#include "render/prepare/lighting/optical_depth_map.h"

namespace render {

/// Everything that casts shadows, occludes the sky or is a light beside the light of the view. A pointer is null where
/// there is nothing of its kind.
struct Occluders {
    LightBasis light;
    glm::vec3 eye{0.0F};  ///< world coordinates, m
    const LightGrid* spheres = nullptr;
    const DepthMap* metaballs = nullptr;
    const DepthMap* meshes = nullptr;
    const LightBoxGrid* lightBoxes = nullptr;
    std::span<const BoxObstacle> boxes;             ///< in world coordinates; what lightBoxes lists
    std::size_t subtractedBoxCount = 0;             ///< number of boxes, the first ones, whose coverage is subtracted
    float softness = 0.0F;                          ///< softness of the shadows' edges, as in Light
    float meanRadius = 0.0F;                        ///< mean radius of the particles, m
    const SkyVisibilityGrid* sky = nullptr;         ///< sky visibility, null without ambient occlusion
    const SkyVisibilityMap* groundSky = nullptr;    ///< sky visibility of the ground, null without ambient occlusion
    const GlowGrid* glow = nullptr;                 ///< light of particles, null if none glows
    const OpticalDepthMap* opticalDepth = nullptr;  ///< of transparent metaballs, null if they are opaque
    float transparency = 0.0F;                      ///< of the metaballs

    bool isEmpty() const {
        return spheres == nullptr && metaballs == nullptr && meshes == nullptr && lightBoxes == nullptr &&
               sky == nullptr && glow == nullptr;
    }
};

/// How much light and sky reaches each shading point, from 0 to 1, and the light of particles.
struct LightVisibility {
    alignas(64)
        std::array<float, kTilePixels> light;  ///< share of the light: 0 in shadow and on surfaces turned away from it
    alignas(
        64) std::array<float, kTilePixels> sky;  ///< share of the sky; 1 on particles, for which ShadingPoints has it
    alignas(64) TileVec3 glow;                   ///< linear RGB of the light of particles; only with hasGlow
    bool hasGlow = false;
    /// The share of `light` that each channel has; only with Occluders::opticalDepth.
    alignas(64) TileVec3 tint;
};

/// Computes how much light and sky reaches each shading point. The values of a point depend on that point alone, bit
/// for bit, not on the instruction set.
void computeLightVisibility(const Occluders& occluders, const ShadingGeometry& geometry, const ShadingPoints& points,
                            LightVisibility& visibility);

}  // namespace render
