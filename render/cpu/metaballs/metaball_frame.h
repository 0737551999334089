// Casts the metaballs of one picture: the hits of every pixel's ray. Called by the picture pass.
#pragma once

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/cpu/metaballs/metaball_scene.h"

namespace render {

/// Which rays are cast.
struct CastSampling {
    glm::vec2 offset{0.0F};      ///< of each pixel's ray from the pixel's middle, pixels
    bool atSilhouettes = false;  ///< adds the rays of castSilhouettes()
    bool isSparse = false;  ///< casts every second pixel of every second row, others where the surface is not smooth
};

/// @param scene  with attributes
/// @param hits   overwritten; its memory is reused
void castMetaballs(const MetaballScene& scene, const CastSampling& sampling, MetaballHits& hits);

}  // namespace render
