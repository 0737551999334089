// A camera as the renderer's stages use it: an orthonormal basis, rays through pixels, and the rectangles of pixels
// that boxes and spheres can touch. The depth map of the metaballs uses one for the light as well, with parallel
// projection.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "render/picture/symmetric_matrix.h"
#include "render/picture/view.h"

namespace render {

/// Offsets of four samples from the center of a pixel, pixels: a rotated grid. The samples lie in four different rows
/// and columns, so that nearly horizontal and vertical silhouettes are drawn in four steps rather than two.
inline constexpr std::array<glm::vec2, 4> kFourSamples = {
    {{-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}}};

/// A rectangle of pixels or cells, the last row and column included. Empty by default.
struct Rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = -1;
    int y1 = -1;
};

/// An orthonormal basis. In view coordinates a point is x right + y up + z forward relative to the eye; z is the view
/// depth. The ray through the point (px, py) of the picture, in pixels from the top left corner, is with
/// X = (2 px/width - 1) halfWidth + middle.x and Y = (1 - 2 py/height) halfHeight + middle.y, in view coordinates:
///   in perspective, from (0, 0, 0) in the direction (X, Y, 1);
///   in parallel projection, from (X, Y, 0) in the direction (0, 0, 1).
struct CameraFrame {
    glm::vec3 eye{0.0F};
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    float halfWidth = 1.0F;   ///< half the width of the picture, m; at view depth 1 in perspective
    float halfHeight = 1.0F;  ///< half the height of the picture, m; at view depth 1 in perspective
    glm::vec2 middle{0.0F};   ///< X and Y of the middle of the picture: Camera::shift
    bool perspective = true;
    int width = 1;  ///< pixels
    int height = 1;

    glm::vec3 toView(glm::vec3 point) const {
        const glm::vec3 offset = point - eye;
        return {dot(offset, right), dot(offset, up), dot(offset, forward)};
    }
    /// Width of a pixel, m: at view depth 1 in perspective, at any depth in parallel projection.
    float pixelWidth() const { return 2.0F * halfHeight / static_cast<float>(height); }

    bool operator==(const CameraFrame&) const = default;
};

/// The basis of a camera for a picture of the given size in pixels.
CameraFrame cameraFrame(const Camera& camera, PictureSize size);

/// The pixels of the picture that an axis-aligned box can touch: the bounds of its projected corners, two pixels wider
/// on each side. Nothing when the box is behind the eye or outside of the picture.
std::optional<Rect> pixelsTouchedByBox(const CameraFrame& frame, glm::vec3 minimum, glm::vec3 maximum);

/// The pixels of the picture that a sphere can touch, one pixel wider on each side. Nothing when the sphere is behind
/// the eye or outside of the picture; every pixel when it reaches the eye's plane, or nearly.
/// @param center  in view coordinates
std::optional<Rect> pixelsTouchedBySphere(const CameraFrame& frame, glm::vec3 center, float radius);

/// The same for an ellipsoid. @param center  in view coordinates
/// @param spread  in view coordinates: along a direction n the ellipsoid reaches sqrt(n^T spread n) from its center, m
std::optional<Rect> pixelsTouchedByEllipsoid(const CameraFrame& frame, glm::vec3 center,
                                             const SymmetricMatrix<float>& spread);

}  // namespace render
