// Computes the basis of a camera, and the bounds in pixels of projected boxes and spheres.
#include "render/picture/camera_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

namespace {

struct Interval {
    double low;
    double high;
};

/// Index of the pixel at a coordinate in pixels, clamped to the range from -1 to count. The number that is converted is
/// not negative, so that the conversion rounds down; std::floor() may be a function call.
int clampedPixel(double at, int count) {
    return static_cast<int>(std::clamp(at, -1.0, static_cast<double>(count)) + 1.0) - 1;
}

/// The pixels that show a rectangle of the plane at view depth 1 (at any depth in parallel projection), and a margin in
/// pixels around it.
std::optional<Rect> pixelsOf(const CameraFrame& frame, Interval x, Interval y, double margin) {
    const double perX = 0.5 * frame.width / frame.halfWidth;
    const double perY = 0.5 * frame.height / frame.halfHeight;
    const glm::dvec2 middle(frame.middle);
    const Rect rect{clampedPixel(0.5 * frame.width + (x.low - middle.x) * perX - margin, frame.width),
                    clampedPixel(0.5 * frame.height - (y.high - middle.y) * perY - margin, frame.height),
                    clampedPixel(0.5 * frame.width + (x.high - middle.x) * perX + margin, frame.width),
                    clampedPixel(0.5 * frame.height - (y.low - middle.y) * perY + margin, frame.height)};
    if (rect.x0 >= frame.width || rect.y0 >= frame.height || rect.x1 < 0 || rect.y1 < 0) return std::nullopt;
    return Rect{std::max(rect.x0, 0), std::max(rect.y0, 0), std::min(rect.x1, frame.width - 1),
                std::min(rect.y1, frame.height - 1)};
}

/// Bounds of a circle with center (a, z) and radius r < z, projected from the eye at (0, 0) onto the line z = 1: the
/// tangents through the eye meet the line at (a z -+ r sqrt(a^2 + z^2 - r^2)) / (z^2 - r^2).
Interval tangents(double a, double z, double r) {
    const double front = (z - r) * (z + r);
    const double root = r * std::sqrt(a * a + front);
    return {(a * z - root) / front, (a * z + root) / front};
}

/// The same of an ellipse, whose half width along a direction n is sqrt(n^T s n): the line x = p z touches it where
/// (a - p z)^2 = s_xx - 2 p s_xz + p^2 s_zz, a quadratic equation for p.
Interval ellipseTangents(double a, double z, double sxx, double sxz, double szz) {
    const double front = z * z - szz;
    const double middle = a * z - sxz;
    const double root = std::sqrt(std::max(0.0, middle * middle - front * (a * a - sxx)));
    return {(middle - root) / front, (middle + root) / front};
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
    // A camera at its own target looks along -z, so that the frame is finite.
    frame.forward = dot(aim, aim) > 0.0F ? normalize(aim) : glm::vec3(0.0F, 0.0F, -1.0F);
    const glm::vec3 side = cross(frame.forward, camera.up);
    const bool upright = dot(side, side) > 1e-12F * dot(camera.up, camera.up);
    frame.right = upright ? normalize(side) : anyPerpendicular(frame.forward);
    frame.up = cross(frame.right, frame.forward);
    frame.perspective = camera.projection == Projection::perspective;
    frame.halfHeight = frame.perspective ? std::tan(0.5F * camera.verticalFov) : camera.halfHeight;
    frame.halfWidth = frame.halfHeight * static_cast<float>(size.width) / static_cast<float>(size.height);
    if (frame.perspective) frame.middle = camera.shift;
    return frame;
}

std::optional<Rect> pixelsTouchedByBox(const CameraFrame& frame, glm::vec3 minimum, glm::vec3 maximum) {
    Interval x{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    Interval y = x;
    int behind = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 at((corner & 1) != 0 ? maximum.x : minimum.x, (corner & 2) != 0 ? maximum.y : minimum.y,
                           (corner & 4) != 0 ? maximum.z : minimum.z);
        const glm::dvec3 view(frame.toView(at));
        // A corner that rounding may have moved across the eye's plane counts as behind it.
        const double least = frame.perspective ? 1e-6 * std::max(std::abs(view.x), std::abs(view.y)) : 0.0;
        if (view.z <= least) ++behind;
        const double scale = frame.perspective && view.z > least ? 1.0 / view.z : 1.0;
        x = {std::min(x.low, view.x * scale), std::max(x.high, view.x * scale)};
        y = {std::min(y.low, view.y * scale), std::max(y.high, view.y * scale)};
    }
    if (behind == 8) return std::nullopt;
    // A box with corners on both sides of the eye's plane may be seen at any pixel.
    if (behind > 0 && frame.perspective) return Rect{0, 0, frame.width - 1, frame.height - 1};
    return pixelsOf(frame, x, y, 2.0);
}

std::optional<Rect> pixelsTouchedBySphere(const CameraFrame& frame, glm::vec3 center, float radius) {
    const glm::dvec3 at(center);
    const double r = double(radius);
    if (at.z + r <= 0.0) return std::nullopt;
    if (!frame.perspective) return pixelsOf(frame, {at.x - r, at.x + r}, {at.y - r, at.y + r}, 1.0);
    // The tangents of a sphere that nearly touches the eye's plane are too imprecise.
    if (at.z <= 1.0001 * r) return Rect{0, 0, frame.width - 1, frame.height - 1};
    return pixelsOf(frame, tangents(at.x, at.z, r), tangents(at.y, at.z, r), 1.0);
}

std::optional<Rect> pixelsTouchedByEllipsoid(const CameraFrame& frame, glm::vec3 center,
                                             const SymmetricMatrix<float>& spread) {
    const glm::dvec3 at(center);
    const SymmetricMatrix<double> s{double(spread.xx), double(spread.yy), double(spread.zz),
                                    double(spread.xy), double(spread.xz), double(spread.yz)};
    const glm::dvec3 half(std::sqrt(s.xx), std::sqrt(s.yy), std::sqrt(s.zz));
    if (at.z + half.z <= 0.0) return std::nullopt;
    if (!frame.perspective) return pixelsOf(frame, {at.x - half.x, at.x + half.x}, {at.y - half.y, at.y + half.y}, 1.0);
    // As of spheres.
    if (at.z <= 1.0001 * half.z) return Rect{0, 0, frame.width - 1, frame.height - 1};
    return pixelsOf(frame, ellipseTangents(at.x, at.z, s.xx, s.xz, s.zz), ellipseTangents(at.y, at.z, s.yy, s.yz, s.zz),
                    1.0);
}

}  // namespace render
