// As many particles at a time as the machine has lanes; this file is compiled once per instruction set.
#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/prepare/ambient_occlusion.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/particle_occlusion.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_occlusion-inl.h"
#include "render/prepare/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

void skyVisibilityOfBatch(const SkyVisibilityGrid& grid, std::span<const Sphere> particles,
                          std::span<SkyVisibility> open) {
    const D d;
    using Lanes = std::array<float, kTileSize>;
    for (std::size_t first = 0; first < particles.size(); first += hn::Lanes(d)) {
        const std::size_t count = std::min(hn::Lanes(d), particles.size() - first);
        alignas(64) std::array<Lanes, 3> center{};
        for (std::size_t lane = 0; lane < count; ++lane)
            for (std::size_t axis = 0; axis < 3; ++axis)
                center[axis][lane] = particles[first + lane].center[static_cast<int>(axis)];
        const Vec3 at =
            gridPosition(grid, glm::vec3(0.0F),
                         {hn::Load(d, center[0].data()), hn::Load(d, center[1].data()), hn::Load(d, center[2].data())});
        alignas(64) std::array<Lanes, 6> values;
        for (std::size_t side = 0; side < 6; ++side)
            hn::Store(skyVisibilityInGrid(grid, side, at), d, values[side].data());
        for (std::size_t lane = 0; lane < count; ++lane)
            for (std::size_t side = 0; side < 6; ++side) open[first + lane][side] = values[side][lane];
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(skyVisibilityOfBatch);

std::vector<SkyVisibility> particleSkyVisibility(std::span<const Sphere> particles, const SkyVisibilityGrid& grid) {
    std::vector<SkyVisibility> open(particles.size(), kUnoccluded);
    if (grid.cells.x == 0) return open;
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.size(), kChunk), [&](const auto& range) {
        HWY_DYNAMIC_DISPATCH(skyVisibilityOfBatch)
        (grid, particles.subspan(range.begin(), range.size()), std::span(open).subspan(range.begin(), range.size()));
    });
    return open;
}

}  // namespace render

#endif
