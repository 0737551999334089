// What an open shutter and a wide lens blur, drawn from the definitions of render/picture/view.h: the mean over many
// moments and many points of the lens of what a ray caster sees. Used by the renderer's tests and by the study of
// pictures.
#pragma once

#include <vector>

#include "studies/oracle/oracle.h"

namespace oracle {

/// The ray through a point of the picture from a point of the lens, which meets the ray from the lens' middle in the
/// plane in focus.
/// @param px, py  pixels, as for pixelRay()
/// @param onLens  right and up from the lens' middle, in its radii
Ray lensRay(const render::View& view, render::PictureSize size, double px, double py, const glm::dvec2& onLens);

/// A view at one of the moments of its shutter, without a shutter.
render::View momentOf(const render::View& view, std::size_t index);

/// A view with blur, with all that is computed once for all rays. Holds a reference to the view.
struct BlurredScene {
    explicit BlurredScene(const render::View& view_);
    BlurredScene(const BlurredScene&) = delete;
    BlurredScene& operator=(const BlurredScene&) = delete;

    const render::View& view;
    std::vector<render::View> views;  ///< at the moments of its shutter; the view itself if it has none
    std::vector<Scene> scenes;        ///< one for each of them
    Scene own;                        ///< the view at its own moment
};

/// Draws a window of a picture with blur: the mean in linear light over the moments of the view's shutter, if it has
/// one, and for each of them over samplesPerAxis^2 samples of each pixel, each from another point of the lens. Kinds,
/// distances and normals are those of the view's own moment from the lens' middle.
Picture drawBlurred(const BlurredScene& blurred, render::PictureSize size, const Window& window, int samplesPerAxis);

}  // namespace oracle
