// What the transparent ones of a tile's shading points show: the points behind them, and what they add to their own
// light. Called by picture_colors.cpp for views with transparent bodies.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/shading/shade.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// The points behind a tile's transparent points.
struct SeenThrough {
    ShadingPoints ends;                           ///< one for each transparent point; its count is theirs
    TransparentShading endShading;                ///< of the ends, which are opaque
    std::array<std::uint8_t, kTilePixels> point;  ///< index of the transparent point before each end
    std::array<glm::vec3, kTilePixels> weight;    ///< share of the end's color that the transparent point shows
    TransparentShading shading;                   ///< of the shading points themselves
};

/// Follows the rays through the transparent ones of some shading points. What a point shows depends on itself alone,
/// bit for bit, not on the instruction set.
/// @param visibility  of the points; null where nothing casts shadows
/// @param behind      overwritten
void findSeenThrough(const PreparedView& view, const ShadingGeometry& geometry, const ShadingPoints& points,
                     const LightVisibility* visibility, SeenThrough& behind);

}  // namespace render
