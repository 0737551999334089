// The points of the lens are those of a sequence without gaps or clusters (Roberts 2018, the R2 sequence), which goes
// on from sample to sample and from moment to moment.
#include "studies/oracle/blur.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/oracle/transparency.h"

namespace oracle {
namespace {

/// Point of this number of the sequence, spread evenly over the lens: its share of the area is its first coordinate.
glm::dvec2 lensPoint(std::size_t number) {
    constexpr double kRoot = 1.32471795724474602596;  // of x^3 = x + 1
    const double share = std::fmod(0.5 + static_cast<double>(number) / kRoot, 1.0);
    const double turn = 2.0 * std::numbers::pi * std::fmod(0.5 + static_cast<double>(number) / (kRoot * kRoot), 1.0);
    return std::sqrt(share) * glm::dvec2(std::cos(turn), std::sin(turn));
}

/// Adds the samples of each pixel at one moment.
/// @param number  of the first point of the lens
void addSamples(const Scene& scene, render::PictureSize size, const Window& window, int samplesPerAxis,
                std::size_t number, std::vector<dvec3>& sums) {
    std::size_t pixel = 0;
    for (int y = window.y; y < window.y + window.height; ++y)
        for (int x = window.x; x < window.x + window.width; ++x, ++pixel)
            for (int j = 0; j < samplesPerAxis; ++j)
                for (int i = 0; i < samplesPerAxis; ++i) {
                    const double px = x + (i + 0.5) / samplesPerAxis;
                    const double py = y + (j + 0.5) / samplesPerAxis;
                    const auto sample = static_cast<std::size_t>(j * samplesPerAxis + i);
                    const Ray ray = lensRay(scene.view, size, px, py, lensPoint(number + sample));
                    sums[pixel] += glm::clamp(colorAlong(scene, ray, size, py), 0.0, 1.0);
                }
}

}  // namespace

Ray lensRay(const render::View& view, render::PictureSize size, double px, double py, const glm::dvec2& onLens) {
    const render::Camera& camera = view.camera;
    const Ray middle = pixelRay(view, size, px, py);
    if (camera.aperture == 0.0F || camera.projection == render::Projection::orthographic) return middle;
    const dvec3 aim = dvec3(camera.target) - dvec3(camera.eye);
    const dvec3 forward = glm::normalize(aim);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(camera.up)));
    const dvec3 up = glm::cross(right, forward);
    const double focus = camera.focus > 0.0F ? double(camera.focus) : glm::length(aim);
    const dvec3 inFocus = middle.origin + middle.direction * (focus / glm::dot(middle.direction, forward));
    const dvec3 origin = middle.origin + 0.5 * double(camera.aperture) * (onLens.x * right + onLens.y * up);
    return {origin, glm::normalize(inFocus - origin)};
}

render::View momentOf(const render::View& view, std::size_t index) {
    const render::Shutter& shutter = view.shutter.value();
    const render::Moment& moment = shutter.moments.at(index);
    render::View at = view;
    at.shutter.reset();
    at.camera = moment.camera;
    at.sphereObstacles = moment.sphereObstacles;
    at.boxObstacles = moment.boxObstacles;
    at.meshObstacles = moment.meshObstacles;
    at.edges = moment.edges;
    for (std::size_t k = 0; k < shutter.velocities.size(); ++k)
        at.particles.at(k).center =
            glm::vec3(dvec3(view.particles.at(k).center) + double(moment.time) * dvec3(shutter.velocities[k]));
    return at;
}

BlurredScene::BlurredScene(const render::View& view_) : view(view_), own(view_) {
    if (!view.shutter) views.push_back(view);
    for (std::size_t k = 0; view.shutter && k < view.shutter->moments.size(); ++k) views.push_back(momentOf(view, k));
    scenes.reserve(views.size());
    for (const render::View& at : views) scenes.emplace_back(at);
}

Picture drawBlurred(const BlurredScene& blurred, render::PictureSize size, const Window& window, int samplesPerAxis) {
    Picture picture = drawWindow(blurred.own, size, window, 1);
    const auto samples = static_cast<std::size_t>(samplesPerAxis * samplesPerAxis);
    std::vector<dvec3> sums(picture.kinds.size(), dvec3(0.0));
    for (std::size_t k = 0; k < blurred.scenes.size(); ++k)
        addSamples(blurred.scenes[k], size, window, samplesPerAxis, k * samples, sums);
    const double count = static_cast<double>(blurred.scenes.size() * samples);
    for (std::size_t pixel = 0; pixel < sums.size(); ++pixel) {
        const dvec3 mean = glm::clamp(sums[pixel] / count, 0.0, 1.0);
        const int x = window.x + static_cast<int>(pixel) % window.width;
        const int y = window.y + static_cast<int>(pixel) / window.width;
        for (int channel = 0; channel < 3; ++channel)
            picture.rgb[3 * pixel + static_cast<std::size_t>(channel)] =
                encodeSrgb(mean[channel], ditherThreshold(x, y));
    }
    return picture;
}

}  // namespace oracle
