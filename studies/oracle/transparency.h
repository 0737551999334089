// Transparent bodies by section 6 of render/picture/shading_model.h, and the light that passes through them by section
// 4, in double precision. Used by oracle.cpp.
#pragma once

#include <glm/glm.hpp>

#include "studies/oracle/oracle.h"

namespace oracle {

/// The linear color of what a ray shows, through all transparent bodies that it meets, before it is clamped to [0, 1].
/// @param py  height of the ray in the picture, pixels from the top
dvec3 colorAlong(const Scene& scene, const Ray& ray, render::PictureSize size, double py);

/// The share of light of each color that the column of metaballs along the light through a point lets pass: 2^-D.
dvec3 columnTransmission(const render::View& view, const dvec3& point);

}  // namespace oracle
