// What a shape tells about a point: how far its surface is, and which way leads away from it.
#pragma once

#include "engine/core/vec3.h"

namespace engine {

/// The signed distance of a point from the surface of a shape.
struct SignedDistance {
    double value = 0.0;             ///< m; positive outside the shape, negative inside
    Vec3 gradient = Vec3::UnitY();  ///< of the value with respect to the point; points away from the shape
};

}  // namespace engine
