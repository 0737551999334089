// Casts the metaballs of one picture: the hits of every pixel's ray. Called by cpu_renderer.cpp.
#pragma once

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/prepare/metaball_scene.h"

namespace render {

/// Which rays are cast for a picture.
struct CastSampling {
    glm::vec2 offset{0.0F};      ///< offset of each pixel's ray from the pixel's middle, pixels
    bool atSilhouettes = false;  ///< whether castSilhouettes() adds rays
    /// Whether only every second pixel of every second row is cast, and the others where the surface is not smooth.
    bool isSparse = false;
};

/// Casts the metaballs of a picture.
/// @param scene  with the attributes of its balls
/// @param hits   overwritten; its memory is reused
void castMetaballs(const MetaballScene& scene, const CastSampling& sampling, MetaballHits& hits);

}  // namespace render
