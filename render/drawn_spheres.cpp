// Places one after another, looks by all threads.
#include "render/drawn_spheres.h"

#include <algorithm>

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

SphereLook particleLook(glm::vec3 color, const Openness& open) {
    return {packedColor(color), packedOpen(open[0], open[2], open[4]), packedOpen(open[1], open[3], open[5]), 1};
}

}  // namespace

DrawnSpheres drawnSpheres(const View& view) {
    DrawnSpheres drawn;
    const auto add = [&](const auto& sphere) {
        if (!(sphere.radius > 0.0F)) return false;
        drawn.spheres.push_back({sphere.center - view.camera.eye, sphere.radius});
        return true;
    };
    if (view.style == Style::spheres) {
        drawn.spheres.reserve(view.particles.size() + view.sphereObstacles.size());
        drawn.particles.reserve(view.particles.size());
        for (std::size_t k = 0; k < view.particles.size(); ++k)
            if (add(view.particles[k])) drawn.particles.push_back(static_cast<std::uint32_t>(k));
    }
    drawn.firstObstacle = static_cast<std::int32_t>(drawn.spheres.size());
    for (const SphereObstacle& obstacle : view.sphereObstacles) add(obstacle);
    return drawn;
}

std::vector<SphereLook> looksOf(const View& view, const DrawnSpheres& drawn, std::span<const Openness> open) {
    std::vector<SphereLook> looks(drawn.particles.size());
    constexpr std::size_t kChunk = 2048;
    tbb::parallel_for(std::size_t{0}, looks.size() / kChunk + 1, [&](std::size_t chunk) {
        for (std::size_t k = chunk * kChunk; k < std::min((chunk + 1) * kChunk, looks.size()); ++k) {
            const std::uint32_t particle = drawn.particles[k];
            looks[k] = particleLook(view.particles[particle].color, open.empty() ? kOpen : open[particle]);
        }
    });
    for (const SphereObstacle& obstacle : view.sphereObstacles)
        if (obstacle.radius > 0.0F) looks.push_back({packedColor(obstacle.color), 0, 0, 0});
    return looks;
}

}  // namespace render
