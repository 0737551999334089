// One thread collects the spheres, all threads pack their attributes.
#include "render/prepare/drawn_spheres.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace render {

namespace {

/// Rounds a value, which is clamped to [0, 1], to an integer from 0 to `largest`.
std::uint32_t quantized(float value, float largest) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(value, 0.0F, 1.0F) * largest + 0.5F));
}

std::uint32_t packedColor(glm::vec3 color) {
    const glm::vec3 root = sqrt(clamp(color, 0.0F, 1.0F));
    return quantized(root.x, 2047.0F) | quantized(root.y, 2047.0F) << 11 | quantized(root.z, 1023.0F) << 22;
}

std::uint32_t packedSky(float x, float y, float z) {
    return quantized(x, 1023.0F) | quantized(y, 1023.0F) << 10 | quantized(z, 1023.0F) << 20;
}

}  // namespace

SphereAttributes particleAttributes(glm::vec3 color, const SkyVisibility& sky) {
    return {packedColor(color), packedSky(sky[0], sky[2], sky[4]), packedSky(sky[1], sky[3], sky[5])};
}

DrawnSpheres drawnSpheres(const View& view) {
    DrawnSpheres drawn;
    const auto addAll = [&](const auto& spheres) {
        for (std::size_t k = 0; k < spheres.size(); ++k) {
            if (!(spheres[k].radius > 0.0F)) continue;
            drawn.spheres.push_back({spheres[k].center - view.camera.eye, spheres[k].radius});
            drawn.sources.push_back(static_cast<std::uint32_t>(k));
        }
    };
    drawn.spheres.reserve(view.particles.size() + view.sphereObstacles.size());
    drawn.sources.reserve(view.particles.size() + view.sphereObstacles.size());
    if (view.style == Style::spheres) addAll(view.particles);
    drawn.firstObstacle = static_cast<std::int32_t>(drawn.spheres.size());
    addAll(view.sphereObstacles);
    return drawn;
}

std::vector<SphereAttributes> sphereAttributes(const View& view, const DrawnSpheres& drawn,
                                               std::span<const SkyVisibility> skyVisibility) {
    std::vector<SphereAttributes> attributes(drawn.sources.size());
    const auto firstObstacle = static_cast<std::size_t>(drawn.firstObstacle);
    constexpr std::size_t kChunk = 2048;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, attributes.size(), kChunk), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            const std::uint32_t source = drawn.sources[k];
            attributes[k] = k < firstObstacle
                                ? particleAttributes(view.particles[source].color,
                                                     skyVisibility.empty() ? kUnoccluded : skyVisibility[source])
                                : SphereAttributes{packedColor(view.sphereObstacles[source].color)};
        }
    });
    return attributes;
}

}  // namespace render
