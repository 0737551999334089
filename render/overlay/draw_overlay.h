// Draws text, scale bar and color bar over a finished picture. Called by the Renderer after the pixels have been read
// back, so that every backend and quality gives the same bytes and a view without an overlay costs nothing.
#pragma once

#include "render/picture/image.h"
#include "render/picture/overlay.h"
#include "render/picture/view.h"

namespace render {

/// Height of the em square of an overlay's text, pixels.
/// @param width  width and height of the picture, pixels
/// @param size  Overlay::size
double overlayEm(int width, int height, double size);

/// Draws the overlay over the picture.
/// @param camera  camera of the picture, on which the length of the scale bar depends
void drawOverlay(Image& image, const Overlay& overlay, const Camera& camera);

}  // namespace render
