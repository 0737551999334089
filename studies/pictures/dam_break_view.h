// The view that pictures are measured on: a dam break that has reached the far wall of its tank and splashes, with any
// number of particles in the same outline. Used by the study of pictures.
#pragma once

#include <cstddef>

#include "render/picture/view.h"

namespace studies {

/// A view of a dam break with ground, soft shadows, ambient occlusion and reflections, whose particles are colored from
/// left to right. The same arguments give the same view.
/// @param count  number of particles, > 0
render::View damBreakView(std::size_t count, render::Style style);

/// A view in `count` frames, between which the camera moves on a circle around its target, so that no two are alike.
std::vector<render::View> framesOf(const render::View& view, int count);

}  // namespace studies
