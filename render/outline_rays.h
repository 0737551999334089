// Extra rays where the outlines of metaballs cross the picture, so that they are smooth. Called by metaball_frame.cpp.
#pragma once

#include "render/field_picture.h"
#include "render/metaball_cast.h"

namespace render {

/// Adds four samples to each pixel of a picture cast with one ray a pixel where it and one beside it see the surface at
/// depths that half a radius does not explain, or one of them sees none. radius: of the smallest ball.
void castOutlines(const FieldCast& cast, float radius, FieldPicture& picture);

}  // namespace render
