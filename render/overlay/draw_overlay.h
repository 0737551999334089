// Text, scale bar and color bar over a finished picture. On the CPU, after the pixels are read back: every backend and
// quality gives the same bytes, and a view without an overlay costs nothing.
#pragma once

#include "render/picture/image.h"
#include "render/picture/overlay.h"
#include "render/picture/view.h"

namespace render {

/// Height of the em square of an overlay's text, pixels.
double overlayEm(int width, int height, double size);

/// Draws what an overlay asks for; camera: the one that the picture was taken with.
void drawOverlay(Image& image, const Overlay& overlay, const Camera& camera);

}  // namespace render
