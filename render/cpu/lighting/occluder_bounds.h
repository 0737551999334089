// Bounds of all that may dim the ground. Called by the picture pass.
#pragma once

#include "render/cpu/lighting/depth_map.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/ground_tiles.h"
#include "render/prepare/light_space.h"

namespace render {

/// What casts shadows and what closes the sky, of one view.
struct Occluders {
    LightBasis light;
    const LightGrid& spheres;
    const DepthMap& field;
    const SkyVisibilityMap* open;  ///< null where the look does not ask for it
    float meanRadius = 0.0F;       ///< of the particles, m
};

OccluderBounds occluderBoundsOf(const View& view, const Occluders& occluders);

}  // namespace render
