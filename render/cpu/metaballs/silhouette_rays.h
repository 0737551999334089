// Extra rays where silhouettes of metaballs cross the picture, so that they are antialiased. Called by
// metaball_frame.cpp.
#pragma once

#include "render/cpu/metaballs/metaball_hits.h"
#include "render/cpu/metaballs/metaball_scene.h"

namespace render {

/// A silhouette runs between two neighboring pixels whose depths differ by more than half the smallest radius, or one
/// of which shows no surface. Of the four samples of both pixels those toward the other pixel are cast, and those that
/// do not show the surface at their pixel's middle are added to the silhouettes of `hits`, which hold one ray per pixel
/// before.
void castSilhouettes(const MetaballScene& scene, MetaballHits& hits);

}  // namespace render
