// Extra rays where silhouettes of metaballs cross the picture, so that they are antialiased. Called by
// metaball_frame.cpp.
#pragma once

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/prepare/metaball_scene.h"

namespace render {

/// Casts extra samples at silhouettes. A silhouette runs between two neighboring pixels whose depths differ by more
/// than half the smallest radius, or one of which shows no surface. In both pixels the samples toward the other pixel
/// are cast. Those that do not show the surface that the middle of their pixel shows are added to the hits.
/// @param hits  holds the hits of one ray per pixel before
void castSilhouettes(const MetaballScene& scene, MetaballHits& hits);

}  // namespace render
