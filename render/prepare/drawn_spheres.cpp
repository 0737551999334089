// Places one after another, looks by all threads.
#include "render/prepare/drawn_spheres.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace render {

namespace {

std::uint32_t bitsOf(float share, float most) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(share, 0.0F, 1.0F) * most + 0.5F));
}

std::uint32_t packedColor(glm::vec3 color) {
    const glm::vec3 root = sqrt(clamp(color, 0.0F, 1.0F));
    return bitsOf(root.x, 2047.0F) | bitsOf(root.y, 2047.0F) << 11 | bitsOf(root.z, 1023.0F) << 22;
}

std::uint32_t packedOpen(float x, float y, float z) {
    return bitsOf(x, 1023.0F) | bitsOf(y, 1023.0F) << 10 | bitsOf(z, 1023.0F) << 20;
}

SphereAttributes particleLook(glm::vec3 color, const SkyVisibility& open) {
    return {packedColor(color), packedOpen(open[0], open[2], open[4]), packedOpen(open[1], open[3], open[5])};
}

}  // namespace

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
                                               std::span<const SkyVisibility> open) {
    std::vector<SphereAttributes> looks(drawn.sources.size());
    const auto firstObstacle = static_cast<std::size_t>(drawn.firstObstacle);
    constexpr std::size_t kChunk = 2048;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, looks.size(), kChunk), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) {
            const std::uint32_t source = drawn.sources[k];
            looks[k] = k < firstObstacle
                           ? particleLook(view.particles[source].color, open.empty() ? kUnoccluded : open[source])
                           : SphereAttributes{packedColor(view.sphereObstacles[source].color)};
        }
    });
    return looks;
}

}  // namespace render
