// The spheres that are drawn as such, and the packed attributes that shading needs of them. Made by the preparation of
// a view.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/lighting/ambient_occlusion.h"

namespace render {

/// Color and sky visibility of a sphere.
struct SphereAttributes {
    std::uint32_t color = 0;     ///< square roots of linear red, green and blue: 11 + 11 + 10 bits, red the lowest
    std::uint32_t skyPlus = 0;   ///< sky visibility along +x, +y, +z: 10 bits each
    std::uint32_t skyMinus = 0;  ///< sky visibility along -x, -y, -z: 10 bits each
    std::uint32_t unused = 0;    ///< pads the struct to 16 bytes, which are loaded at once
};

/// Packs what shading needs of a particle.
SphereAttributes particleAttributes(glm::vec3 color, const SkyVisibility& sky);

/// The spheres of a view that are drawn as spheres.
struct DrawnSpheres {
    std::vector<ViewSphere> spheres;     ///< particles, then obstacles; relative to the eye, in world axes
    std::vector<std::uint32_t> sources;  ///< index in the view of each sphere's particle or obstacle
    std::int32_t firstObstacle = 0;      ///< index of the first obstacle in `spheres`
};

/// The particles unless they are metaballs, and the sphere obstacles. Spheres whose radius is not positive are left
/// out.
DrawnSpheres drawnSpheres(const View& view);

/// The attributes of each drawn sphere.
/// @param skyVisibility  sky visibility of each particle of the view, or empty
std::vector<SphereAttributes> sphereAttributes(const View& view, const DrawnSpheres& drawn,
                                               std::span<const SkyVisibility> skyVisibility);

}  // namespace render
