// Where a ray of any direction crosses the surface of metaballs. Called by light_path.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/prepare/rays/ball_cells.h"
#include "render/prepare/rays/ball_set.h"
#include "render/prepare/rays/field_cells.h"

namespace render {

inline constexpr float kNoCrossing = std::numeric_limits<float>::infinity();

/// A part of a ray, in the coordinates of the balls' cells. A point at the distance t is origin + t direction.
struct RayPart {
    glm::vec3 origin{0.0F};
    glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< unit length
    float from = 0.0F;                       ///< distances at which the part begins and ends, m
    float to = kNoCrossing;
};

class BallCache;

/// The field of metaballs and the sampling of rays through it.
struct CastField {
    const BallCells& cells;
    const FieldCells& sides;  ///< of the same balls and threshold
    float threshold = 0.5F;   ///< value of the field at the surface
    float step = 0.05F;       ///< greatest distance between two samples on a ray, m
    BallCache& cache;         ///< of the same balls
};

/// A point of the surface.
struct SurfacePoint {
    float distance = kNoCrossing;  ///< from the ray's origin, m; kNoCrossing if there is none
    glm::vec3 normal{0.0F};        ///< unit normal that points out of the metaballs
    const BallSet* balls =
        nullptr;  ///< among which are all that reach the point, until the next search; null if none do
};

/// Finds the first point of a part of a ray at which the field is no longer on the side of the threshold that the ray
/// is on. Bodies and gaps that are thinner than a step may be missed where neither the samples around them nor the
/// field's slope there show them.
/// @param isInside  whether the ray begins inside the metaballs, whatever the field is where the part begins
///
/// The result depends on the ray and the field alone, bit for bit, not on the instruction set.
SurfacePoint findCrossing(const CastField& field, const RayPart& ray, bool isInside);

/// A ball's share of the field at a point.
struct BallShare {
    std::int32_t particle = 0;  ///< index in the view of the particle that the ball stands for
    float kernel = 0.0F;        ///< value of its kernel
};

/// The balls of a set whose kernels reach a point.
/// @param shares  overwritten; its memory is reused
void findShares(const BallCells& cells, const BallSet& balls, glm::vec3 point, std::vector<BallShare>& shares);

}  // namespace render
