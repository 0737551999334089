// What the rays through the middles of the pixels hit, as layers of a picture: points of surfaces, and the particles
// that they belong to. Called by cpu_renderer.cpp.
#pragma once

#include <cstdint>
#include <span>

#include "render/cpu/picture_colors.h"
#include "render/picture/layers.h"
#include "render/prepare/prepared_view.h"

namespace render {

/// Finds the layers Layers::points and Layers::ids, those of them that are wanted. What a pixel gets depends on its own
/// ray alone, bit for bit, not on the instruction set.
/// @param job  whose hits are those of rays through the middles of the pixels
/// @param layers  of which only the wanted ones are written
void findSurfaceLayers(const PictureJob& job, const PreparedView& view, const LayerSelection& wanted, Layers& layers);

}  // namespace render
