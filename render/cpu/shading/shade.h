// Colors of shading points by the shading model of view.h. Called by picture_colors.cpp.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/picture/view.h"
#include "render/prepare/tiles.h"

namespace render {

/// What all points of one picture share.
struct Shading {
    Light light;  ///< toLight of unit length
    Ambient ambient;
    Surface surface;  ///< of particles
    Surroundings surroundings;
    float exposure = 0.0F;
    Background background;
    glm::vec3 groundCenter{0.0F};  ///< relative to the eye
    float fadeDistance = 1.0F;     ///< m
    glm::vec3 openGround{0.0F};    ///< color of ground that nothing occludes, before it fades into the background
};

Shading shadingOf(const View& view);

/// Linear colors from 0 to 1 of up to a tile's worth of points.
struct PointColors {
    alignas(64) TileVec3 rgb;
};

/// A point's color depends on the point alone, bit for bit, not on the instruction set.
/// @param visibility  null where nothing casts shadows or occludes the sky
void shade(const Shading& shading, const ShadingGeometry& geometry, const ShadingPoints& points,
           const LightVisibility* visibility, PointColors& colors);

/// sRGB, 8 bits per channel, red in the lowest.
using PixelColor = std::uint32_t;

/// Encodes all kTilePixels colors in their order.
void encodeColors(const PointColors& colors, PixelColor* pixels);

}  // namespace render
