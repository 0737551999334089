// Colors of shading points and of tiles of background, by the shading model of shading_model.h. Called by
// picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"

namespace render {

/// The parameters of the shading model, which all points of one picture share.
struct Shading {
    Light light;  ///< with a toLight of unit length
    Ambient ambient;
    Surface surface;  ///< surface of the particles
    Surroundings surroundings;
    float exposure = 0.0F;
    Background background;
    glm::vec3 groundCenter{0.0F};  ///< center of the ground relative to the eye, m
    float fadeDistance = 1.0F;     ///< distance from its center at which the ground is half faded, m
    glm::vec3 openGround{0.0F};    ///< color of ground that nothing occludes, before it fades into the background
};

Shading shadingOf(const View& view);

/// Linear colors from 0 to 1 of up to a tile's worth of points.
struct PointColors {
    alignas(64) TileVec3 rgb;
};

/// What shading needs beside the points themselves in a view with transparent bodies.
struct TransparentShading {
    alignas(64) TileVec3 direction;                        ///< of the ray that met each point, unit length
    alignas(64) std::array<float, kTilePixels> bodyShare;  ///< share of the body's color that is seen
    const TileVec3* tint = nullptr;  ///< of the light that reaches each point; null if it is that of the light
    alignas(64) TileVec3 added;      ///< light that is mirrored in addition
};

/// Colors shading points. The color of a point depends on that point alone, bit for bit, not on the instruction set.
/// @param visibility    null where nothing casts shadows or occludes the sky
/// @param transparency  null if all points are opaque and met by rays from the eye
void shade(const Shading& shading, const ShadingGeometry& geometry, const ShadingPoints& points,
           const LightVisibility* visibility, const TransparentShading* transparency, PointColors& colors);

/// A pixel in sRGB: 8 bits per channel, red in the lowest byte.
using PixelColor = std::uint32_t;

/// How colors are rounded to whole steps of 1/255: to the nearest, or by the dither of section 5 of shading_model.h.
enum class Rounding { nearest, dithered };

/// Encodes kTilePixels colors as sRGB. Dithered ones are those of a tile's points, ordered along kZCurve.
void encodeColors(const PointColors& colors, Rounding rounding, PixelColor* pixels);

/// Where a tile's pixels are written.
struct TileTarget {
    glm::ivec2 corner{0};   ///< top left of the tile, pixels of the picture
    PixelColor* first;      ///< pixel at the top left of the tile
    std::size_t rowLength;  ///< length of a row of the picture, in pixels, rounded up to whole tiles
};

/// Colors a tile that shows nothing but background or, with isGround, nothing but ground that nothing occludes.
void colorBackgroundTile(const ShadingGeometry& geometry, const Shading& shading, bool isGround,
                         const TileTarget& target);

}  // namespace render
