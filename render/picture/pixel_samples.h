// The samples of a pixel in final quality: where in the pixel each lies, at which moment of the open shutter it is
// taken, and through which point of the lens. Used by the Renderer, which draws a view once for each sample if they
// differ in more than their places, and by scenes/view, which makes the moments of a view.
//
// A picture is the mean over its samples, so that each of the three has to be spread evenly on its own. Moments must go
// together with neither of the others: a moving edge would show another blur than one at rest, or one side of the lens
// an earlier moment than the other. (Place and point of the lens may: what is blurred by the lens over several pixels
// moves by a part of one.) With n samples along each axis of the pixel:
//   - Places are a regular grid of n x n, row by row: sample n i + j is in row i and column j.
//   - Moments are those of sampleTime() in view.h.
//   - Points of the lens are n^2 on a spiral from its middle to its rim (Vogel 1979, A Better Way to Construct the
//     Sunflower Head): point l is at sqrt((l + 1/2)/n^2) of the radius, each a golden angle on from the last. Every
//     ring of the lens thus has its share of them, on all sides. The sample at part n a + b of the shutter's time takes
//     point n ((b + 2) mod n) + (a + b) mod n. Chosen among the orders of this form for the least correlation between
//     moments and points: 0.30 at most, with 4 x 4 samples; 0.22 with 3 x 3, 0.07 with 6 x 6 (blur_test.cpp).
#pragma once

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

struct PixelSample {
    glm::vec2 offset{0.0F};  ///< from the middle of the pixel, pixels
    double time = 0.0;       ///< of the moment, from -1/2, when the shutter opens, to 1/2, when it closes
    glm::vec2 onLens{0.0F};  ///< point of the lens, right and up from its middle, in its radii
};

/// Sample of this index, from 0 to samplesPerAxis^2 - 1. It is the same on every machine.
PixelSample pixelSample(int index, int samplesPerAxis);

/// Whether the samples of a pixel see different scenes: through different points of the lens, or at different moments.
bool hasBlur(const View& view);

/// A camera that sees through one point of a camera's lens, in parallel to its axis, with the picture's middle shifted
/// so that every point of the plane in focus stays in its place on the picture.
Camera throughLens(const Camera& camera, glm::vec2 onLens);

/// What one sample of a view sees, as a view without blur.
/// @param sampled  a copy of the view, or what an earlier call for the view has left
/// @throws std::logic_error if the shutter has not a moment for each sample and a velocity for each particle
void setSample(const View& view, int index, View& sampled);

}  // namespace render
