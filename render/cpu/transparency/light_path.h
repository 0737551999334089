// The way of a ray through transparent bodies to what is seen behind them, by section 6 of shading_model.h. Called by
// see_through.cpp.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/lighting/shading_points.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// The point where a ray from the eye first meets a transparent body.
struct FirstSurface {
    glm::vec3 position{0.0F};   ///< relative to the eye, m
    glm::vec3 direction{0.0F};  ///< of the ray, unit length
    glm::vec3 normal{0.0F};     ///< unit normal on the side of the eye
    glm::vec3 color{0.0F};      ///< of the surface
    std::int32_t hitId = 0;     ///< of metaballs or a triangle
};

/// What a ray shows behind a transparent body.
struct LightPath {
    glm::vec3 weight{1.0F};     ///< share of the light from the end that arrives: W of shading_model.h
    glm::vec3 mirrored{0.0F};   ///< light that later surfaces mirror
    float length = 0.0F;        ///< from the first surface to the end, m
    glm::vec3 direction{0.0F};  ///< of the ray at its end, unit length
    // The end; for the background only the hit id:
    std::int32_t hitId = kHitBackground;  ///< kHitMetaballs for any point of metaballs
    glm::vec3 position{0.0F};             ///< relative to the eye, m
    glm::vec3 normal{0.0F};               ///< unit normal on the side of the ray
    glm::vec3 color{0.0F};
    glm::vec3 sky{1.0F};  ///< sky visibility of particles along the normal, against it and along the mirrored ray
};

/// The transparent body that a primary hit shows; null if what it hits is not transparent.
const Medium* mediumOf(const PreparedView& view, std::int32_t hitId);

class BallCache;

/// Follows a ray from its first transparent surface on. @pre the view has transparent bodies
/// @param cache  of this view's balls
LightPath followRay(const PreparedView& view, const ShadingGeometry& geometry, const FirstSurface& first,
                    BallCache& cache);

/// The share of light that a surface between media with these refractive indices mirrors, by Schlick's approximation.
/// @param cosine  of the ray's angle with the normal, on the side of the first medium
float mirroredShare(float from, float to, float cosine);

/// What mirrors show in a direction: surroundings(d) of shading_model.h.
glm::vec3 surroundingsToward(const Surroundings& around, glm::vec3 direction);

}  // namespace render
