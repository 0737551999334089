// Extra rays where the outlines of metaballs cross the picture, so that they are smooth. Called by metaball_frame.cpp.
#pragma once

#include "render/cpu/metaballs/field_picture.h"
#include "render/cpu/metaballs/metaball_cast.h"

namespace render {

/// Looks again where a pixel and one beside it see the surface at depths that half a radius does not explain, or one of
/// them sees none: an outline runs between their middles. Of the pixel's four samples those on that side are cast, and
/// kept where they do not show the middle's surface. picture: cast with one ray a pixel. radius: of the smallest ball.
void castOutlines(const FieldCast& cast, float radius, FieldPicture& picture);

}  // namespace render
