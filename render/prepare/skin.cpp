// Balls pulled toward where others are, and lighter the more of them there are.
#include "render/prepare/skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include <tbb/parallel_for.h>

#include "render/prepare/density_sums.h"
#include "render/prepare/skin_cells.h"

namespace render {

namespace {

SkinBall smoothed(const DensitySum& sum, glm::vec3 center) {
    // crowd^(-3/4): between a sum, which swells where many overlap, and a mean, which sinks in at the border.
    const float root = std::sqrt(sum.density);
    return {center + kSkinPull * sum.weightedOffset / sum.density, 1.0F / (root * std::sqrt(root))};
}

}  // namespace

std::vector<SkinBall> skinOf(const View& view) {
    std::vector<SkinBall> balls(view.particles.size());
    if (view.field.skin == Skin::plain) {
        for (std::size_t k = 0; k < balls.size(); ++k) balls[k].center = view.particles[k].center;
        return balls;
    }
    if (balls.empty()) return balls;
    const SkinCells cells = skinCells(view.particles, view.field.reach);
    constexpr std::size_t kChunk = 128;
    tbb::parallel_for(std::size_t{0}, (balls.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk;
        std::array<DensitySum, kChunk> room;
        const std::span<DensitySum> sums = std::span(room).first(std::min(kChunk, balls.size() - first));
        densitySums(cells, view.field.reach, first, sums);
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const std::uint32_t index = cells.index[first + k];
            const Sphere& particle = view.particles[index];
            if (particle.radius > 0.0F) balls[index] = smoothed(sums[k], particle.center);
        }
    });
    return balls;
}

}  // namespace render
