// Spheres that are drawn as such, and what they look like. Made by the picture pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/tiles.h"

namespace render {

/// What a sphere looks like, packed.
struct SphereAttributes {
    std::uint32_t color = 0;    ///< square roots, 11 + 11 + 10 bits
    std::uint32_t skyPlus = 0;  ///< openness along +x, +y, +z, 10 bits each
    std::uint32_t skyMinus = 0;
    std::uint32_t unused = 0;  ///< lanes load four numbers at once
};

struct DrawnSpheres {
    std::vector<ViewSphere> spheres;     ///< center relative to the eye, in world axes; particles first
    std::vector<std::uint32_t> sources;  ///< which particle each is and, from firstObstacle on, which obstacle
    std::int32_t firstObstacle = 0;
};

/// Obstacles always, particles unless they are metaballs; radii not above zero are left out.
DrawnSpheres drawnSpheres(const View& view);

/// Of each drawn sphere; open: of each particle of the view, or empty.
std::vector<SphereAttributes> sphereAttributes(const View& view, const DrawnSpheres& drawn,
                                               std::span<const SkyVisibility> open);

}  // namespace render
