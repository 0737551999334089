// A camera as the passes use it: an orthonormal basis, rays through pixels, and the rectangle of pixels that a box can
// touch. The light is such a camera too (parallel projection along the light).
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// Four samples a pixel on a rotated grid: four different rows and columns, so edges near the horizontal and the
/// vertical get four steps, not two.
inline constexpr std::array<glm::vec2, 4> kFourSamples = {
    {{-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}}};

/// Pixels or cells, both ends included.
struct Rect {
    int x0 = 0;
    int y0 = 0;
    int x1 = -1;
    int y1 = -1;
};

/// Seen from here a point is p = x right + y up + z forward, relative to the eye; z is the view depth.
/// Holds:  right, up, forward are orthonormal; pixel (px, py) looks along (halfWidth X, halfHeight Y, 1) from the eye
/// in
///         perspective, along (0, 0, 1) from (halfWidth X, halfHeight Y, 0) in parallel projection, where X = 2
///         px/width - 1 and Y = 1 - 2 py/height.
struct CameraFrame {
    glm::vec3 eye{0.0F};
    glm::vec3 right{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec3 forward{0.0F, 0.0F, -1.0F};
    float halfWidth = 1.0F;
    float halfHeight = 1.0F;
    bool perspective = true;
    int width = 1;  ///< pixels
    int height = 1;

    glm::vec3 toView(glm::vec3 point) const {
        const glm::vec3 offset = point - eye;
        return {dot(offset, right), dot(offset, up), dot(offset, forward)};
    }
    /// Width of a pixel in meters: at view depth 1 in perspective, at any depth in parallel projection.
    float pixelWidth() const { return 2.0F * halfHeight / static_cast<float>(height); }

    bool operator==(const CameraFrame&) const = default;
};

CameraFrame cameraFrame(const Camera& camera, PictureSize size);

/// The pixels that a box given by two corners in world axes can touch, within the picture; empty when it is behind the
/// eye or outside the picture. The rectangle is that of its projected corners, two pixels wider.
std::optional<Rect> pixelsTouchedByBox(const CameraFrame& frame, glm::vec3 minimum, glm::vec3 maximum);

}  // namespace render
