// The scene that pictures are measured on: a dam of liquid that has run to the far wall of its tank and splashes, as
// many particles as one likes in the same outline. Used by the study of pictures.
#pragma once

#include <cstddef>

#include "render/picture/view.h"

namespace studies {

/// The dam with ground, soft shadows, occlusion and wet reflections, particles colored from left to right. The same
/// numbers give the same view. Shape: count > 0.
render::View damBreakView(std::size_t count, render::Style style);

/// The view from places a little further and further on a circle around its target, so that no two frames are alike.
std::vector<render::View> framesOf(const render::View& view, int count);

}  // namespace studies
