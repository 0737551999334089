// Compares windows of the renderer's picture with the oracle's exact picture. See errorOf() in pictures.h.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/compare/picture_metrics.h"
#include "studies/pictures/pictures.h"

namespace studies {
namespace {

/// Sums of errors over the pixels of all windows; similarity alone is a sum over the windows.
struct Sums {
    double squares = 0.0;               ///< squared color differences, for each pixel the mean over its channels
    double similarity = 0.0;            ///< structural similarity
    double depth = 0.0;                 ///< errors of depth on particles, mean radii
    double normal = 0.0;                ///< errors of the normal on particles, degrees
    std::size_t wrongHits = 0;          ///< pixels that show another surface than the exact picture
    std::size_t rightParticleHits = 0;  ///< pixels that show the right point of a particle
    std::size_t pixels = 0;
};

/// The part of a picture inside a window.
render::Image cropped(const render::Image& image, const oracle::Window& window) {
    render::Image part{window.width, window.height, {}};
    for (int y = window.y; y < window.y + window.height; ++y) {
        const auto first = image.rgb.begin() + 3 * (std::ptrdiff_t{y} * image.width + window.x);
        part.rgb.insert(part.rgb.end(), first, first + 3 * std::ptrdiff_t{window.width});
    }
    return part;
}

/// Adds the color errors inside a window to the sums.
void addColors(const render::Image& image, const ExactWindow& exact, Sums& sums) {
    const render::Image shown = cropped(image, exact.window);
    const render::Image wanted{exact.window.width, exact.window.height, exact.picture.rgb};
    const render::PictureMetrics metrics = render::measure(shown, wanted, {}, 0);
    sums.squares += metrics.meanSquare * static_cast<double>(metrics.pixelCount);
    sums.similarity += metrics.ssim;
}

/// Adds the errors of the visible surfaces inside a window, their depths and their normals, to the sums.
void addSurfaces(const render::View& view, render::PictureSize size, std::span<const render::VisiblePoint> surfaces,
                 const ExactWindow& exact, Sums& sums) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.camera.target) - glm::dvec3(view.camera.eye));
    const double radius = oracle::meanRadius(view);
    for (std::size_t k = 0; k < exact.picture.kinds.size(); ++k) {
        const int x = exact.window.x + static_cast<int>(k) % exact.window.width;
        const int y = exact.window.y + static_cast<int>(k) / exact.window.width;
        const render::VisiblePoint& seen = surfaces[static_cast<std::size_t>(y * size.width + x)];
        const oracle::Hit::Kind kind = exact.picture.kinds[k];
        ++sums.pixels;
        const bool isHit = kind != oracle::Hit::Kind::none;
        if (isHit != (seen.depth >= 0.0F)) ++sums.wrongHits;
        if (!isHit || seen.depth < 0.0F) continue;
        const oracle::Ray ray = oracle::pixelRay(view, size, x + 0.5, y + 0.5);
        const double depth = exact.picture.distances[k] * glm::dot(ray.direction, forward);
        const double error = std::abs(double(seen.depth) - depth) / radius;
        // The ground is far away and seen at a grazing angle, where single precision shifts the depth by more.
        const bool isRight = error <= 0.1 + 1e-5 * depth / radius;
        if (!isRight) ++sums.wrongHits;
        if (!isRight || kind != oracle::Hit::Kind::particle) continue;
        ++sums.rightParticleHits;
        sums.depth += error;
        const double cosine = glm::dot(glm::dvec3(seen.normal), exact.picture.normals[k]);
        const double sine = glm::length(glm::cross(glm::dvec3(seen.normal), exact.picture.normals[k]));
        sums.normal += std::atan2(sine, cosine) * 180.0 / std::numbers::pi;
    }
}

}  // namespace

PictureError errorOf(const render::Image& image, std::span<const render::VisiblePoint> surfaces,
                     const render::View& view, std::span<const ExactWindow> exact) {
    Sums sums;
    for (const ExactWindow& window : exact) {
        addColors(image, window, sums);
        addSurfaces(view, {image.width, image.height}, surfaces, window, sums);
    }
    PictureError error;
    error.pixels = sums.pixels;
    error.rmse = std::sqrt(sums.squares / static_cast<double>(sums.pixels));
    error.ssim = sums.similarity / static_cast<double>(exact.size());
    error.wrongHits = static_cast<double>(sums.wrongHits) / static_cast<double>(sums.pixels);
    const auto hits = static_cast<double>(std::max<std::size_t>(sums.rightParticleHits, 1));
    error.depth = sums.depth / hits;
    error.normal = sums.normal / hits;
    return error;
}

}  // namespace studies
