// Colors of the points that a picture shows: the shading model of view.h. Called by picture_colors.cpp.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/picture/view.h"
#include "render/prepare/light_space.h"

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
    float fadeDistance = 1.0F;
};

Shading shadingOf(const View& view);

/// Linear, from 0 to 1.
struct PointColors {
    alignas(64) std::array<std::array<float, kTilePixels>, 3> rgb;
};

/// reach: null where nothing dims these points.
/// Holds:  a point's color depends on the point alone, bit for bit, not on the number of lanes.
void shade(const Shading& shading, const Surfaces& surfaces, const SurfacePoints& points, const LightReach* reach,
           PointColors& colors);

/// sRGB, a byte a channel, the lowest red.
using PixelColor = std::uint32_t;

/// Shape:  pixels: kTilePixels of them; colors: all of them.
void packColors(const PointColors& colors, PixelColor* pixels);

/// The ground's color where nothing dims it, before it fades. A matt surface looks the same from everywhere.
glm::vec3 unoccludedGround(const Shading& shading, glm::vec3 albedo);

}  // namespace render
