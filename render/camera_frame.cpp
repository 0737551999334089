// Camera basis and bounds of projected spheres. Used by the binning, the ray cast and the uniforms alike.
#include "render/camera_frame.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

struct Interval {
    double low;
    double high;
};

// Tangents from the eye to the circle (a, z, r): a/z runs over (a z -+ r sqrt(a^2 + z^2 - r^2)) / (z^2 - r^2), for z > r.
Interval tangents(double a, double z, double r) {
    const double root = r * std::sqrt(std::max(a * a + z * z - r * r, 0.0));
    const double scale = 1.0 / (z * z - r * r);
    return {(a * z - root) * scale, (a * z + root) * scale};
}

int clampedPixel(double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at), -1.0, static_cast<double>(count)));
}

glm::vec3 anyPerpendicular(glm::vec3 direction) {
    const glm::vec3 other = std::abs(direction.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    return normalize(cross(direction, other));
}

}  // namespace

CameraFrame cameraFrame(const Camera& camera, PictureSize size) {
    CameraFrame frame;
    frame.eye = camera.eye;
    frame.width = size.width;
    frame.height = size.height;
    const glm::vec3 aim = camera.target - camera.eye;
    // A camera on its own target looks along -z rather than nowhere.
    frame.forward = dot(aim, aim) > 0.0F ? normalize(aim) : glm::vec3(0.0F, 0.0F, -1.0F);
    const glm::vec3 side = cross(frame.forward, camera.up);
    const bool upright = dot(side, side) > 1e-12F * dot(camera.up, camera.up);
    frame.right = upright ? normalize(side) : anyPerpendicular(frame.forward);
    frame.up = cross(frame.right, frame.forward);
    frame.perspective = camera.projection == Projection::perspective;
    frame.halfHeight = frame.perspective ? std::tan(0.5F * camera.verticalFov) : camera.halfHeight;
    frame.halfWidth = frame.halfHeight * static_cast<float>(size.width) / static_cast<float>(size.height);
    return frame;
}

std::optional<Rect> pixelsTouched(const CameraFrame& frame, glm::vec3 center, float radius) {
    const double z = center.z;
    const double r = radius;
    if (z + r <= 0.0) return std::nullopt;
    Rect whole{0, 0, frame.width - 1, frame.height - 1};
    Interval x{center.x - r, center.x + r};
    Interval y{center.y - r, center.y + r};
    if (frame.perspective) {
        // Touching the eye's plane to within rounding: the tangents are useless there.
        if (z <= r * 1.0001) return whole;
        x = tangents(center.x, z, r);
        y = tangents(center.y, z, r);
    }
    const double perX = 0.5 * frame.width / frame.halfWidth;
    const double perY = 0.5 * frame.height / frame.halfHeight;
    Rect rect;
    rect.x0 = clampedPixel(0.5 * frame.width + x.low * perX - 1.0, frame.width);
    rect.x1 = clampedPixel(0.5 * frame.width + x.high * perX + 1.0, frame.width);
    rect.y0 = clampedPixel(0.5 * frame.height - y.high * perY - 1.0, frame.height);
    rect.y1 = clampedPixel(0.5 * frame.height - y.low * perY + 1.0, frame.height);
    if (rect.x0 >= frame.width || rect.y0 >= frame.height || rect.x1 < 0 || rect.y1 < 0) return std::nullopt;
    return Rect{std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, whole.x1), std::min(rect.y1, whole.y1)};
}

}  // namespace render
