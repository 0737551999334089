// Where a ray of any direction meets spheres, boxes, triangles and the ground. Called by light_path.cpp.
#pragma once

#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

#include "render/cpu/lighting/shading_points.h"
#include "render/prepare/cells/hit_ids.h"
#include "render/prepare/rays/solid_tree.h"

namespace render {

/// What a ray meets.
struct SolidHit {
    float distance = std::numeric_limits<float>::infinity();  ///< from the ray's origin, m
    std::int32_t hitId = kHitBackground;

    bool isNone() const { return hitId == kHitBackground; }
};

/// The surface at a hit.
struct SolidSurface {
    glm::vec3 normal{0.0F};  ///< unit normal as it is shaded, on the side that the ray comes from
    glm::vec3 color{0.0F};   ///< linear RGB
    bool isInner = false;    ///< whether the ray comes from the inside
};

/// Finds the nearest solid or ground along a ray.
/// @param origin     relative to the eye, m
/// @param direction  unit length
/// @param least      hits do not count up to this distance, m
/// @param most       nor beyond this one
SolidHit nearestSolid(const SolidTree& tree, const ShadingGeometry& geometry, glm::vec3 origin, glm::vec3 direction,
                      float least, float most = std::numeric_limits<float>::infinity());

/// The surface that a ray meets. @pre the hit is one of this ray, not of the background
SolidSurface surfaceAt(const ShadingGeometry& geometry, glm::vec3 origin, glm::vec3 direction, const SolidHit& hit);

}  // namespace render
