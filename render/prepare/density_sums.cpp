// All in reach of a cell's particles, gathered once, and sixteen sums side by side, however many lanes there are, added
// up in a fixed order, so that every instruction set gives the same bits; this file is compiled once per instruction
// set.
#include "render/prepare/density_sums.h"

#include <algorithm>
#include <array>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/prepare/density_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/prepare/simd_rays-inl.h"

#ifndef RENDER_NEIGHBORHOOD
#define RENDER_NEIGHBORHOOD
namespace render {
/// Particles side by side: x, y, z and radius, in whole blocks.
struct Neighborhood {
    std::size_t size = 0;
    std::array<std::vector<float>, 4> values;  // alike in room for more than `size`
};
}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr std::size_t kVectorsPerBlock = kDensityBlock / hn::MaxLanes(D());
using BlockSum = std::array<V, kVectorsPerBlock>;

HWY_INLINE void copyBlock(const float* from, float* to) {
    for (std::size_t lane = 0; lane < kDensityBlock; lane += hn::Lanes(D()))
        hn::StoreU(hn::LoadU(D(), from + lane), D(), to + lane);
}

/// All that may be in reach of the particles of one cell, themselves included.
void gather(const SkinCells& cells, glm::ivec3 cell, Neighborhood& neighborhood) {
    const glm::ivec3 first = max(cell - 1, glm::ivec3(0));
    const glm::ivec3 last = min(cell + 1, cells.count - 1);
    const std::array<const float*, 4> from = {cells.x.data(), cells.y.data(), cells.z.data(), cells.radius.data()};
    neighborhood.size = 0;
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            const std::size_t begin = cells.begin[cells.cellIndex(first.x, y, z)];
            const std::size_t count = cells.begin[cells.cellIndex(last.x, y, z) + 1] - begin;
            if (neighborhood.values[0].size() < neighborhood.size + count + 2 * kDensityBlock)
                for (std::vector<float>& values : neighborhood.values)
                    values.resize(2 * (neighborhood.size + count + kDensityBlock));
            // What a block holds beyond `count` is written over.
            for (std::size_t value = 0; value < 4; ++value)
                for (std::size_t k = 0; k < count; k += kDensityBlock)
                    copyBlock(from[value] + begin + k, &neighborhood.values[value][neighborhood.size + k]);
            neighborhood.size += count;
        }
    }
    // Far beyond any reach, and its distance squared still a number.
    constexpr std::array<float, 4> kOutOfReach = {1e18F, 1e18F, 1e18F, 0.0F};
    for (std::size_t value = 0; value < 4; ++value)
        std::fill_n(&neighborhood.values[value][neighborhood.size], kDensityBlock, kOutOfReach[value]);
    neighborhood.size = (neighborhood.size + kDensityBlock - 1) / kDensityBlock * kDensityBlock;
}

/// The sum of sixteen, the second half added to the first until one is left.
HWY_INLINE float sumOf(const BlockSum& parts) {
    const hn::CappedTag<float, 4> d;
    alignas(64) std::array<float, kDensityBlock> sums;
    for (std::size_t part = 0; part < kVectorsPerBlock; ++part)
        hn::Store(parts[part], D(), &sums[part * hn::Lanes(D())]);
    for (const std::size_t half : {std::size_t{8}, std::size_t{4}})
        for (std::size_t k = 0; k < half; k += hn::Lanes(d))
            hn::Store(hn::Add(hn::Load(d, &sums[k]), hn::Load(d, &sums[k + half])), d, &sums[k]);
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

DensitySum sumOver(const Neighborhood& neighborhood, glm::vec4 particle, float reach) {
    const D d;
    const Vec3 here = splat(glm::vec3(particle));
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    BlockSum share, pullX, pullY, pullZ;
    for (BlockSum* parts : {&share, &pullX, &pullY, &pullZ}) parts->fill(zero);
    const auto& [x, y, z, radius] = neighborhood.values;
    for (std::size_t block = 0; block < neighborhood.size; block += kDensityBlock) {
        for (std::size_t part = 0; part < kVectorsPerBlock; ++part) {
            const std::size_t k = block + part * hn::Lanes(d);
            const Vec3 off{hn::Sub(hn::LoadU(d, &x[k]), here.x), hn::Sub(hn::LoadU(d, &y[k]), here.y),
                           hn::Sub(hn::LoadU(d, &z[k]), here.z)};
            const V far = hn::Mul(splat(0.5F * reach), hn::Add(splat(particle.w), hn::LoadU(d, &radius[k])));
            const V root = hn::Max(zero, hn::Sub(one, hn::Div(dot(off, off), hn::Mul(far, far))));
            const V weight = hn::Mul(root, root);
            share[part] = hn::Add(share[part], weight);
            pullX[part] = hn::Add(pullX[part], hn::Mul(weight, off.x));
            pullY[part] = hn::Add(pullY[part], hn::Mul(weight, off.y));
            pullZ[part] = hn::Add(pullZ[part], hn::Mul(weight, off.z));
        }
    }
    return {sumOf(share), {sumOf(pullX), sumOf(pullY), sumOf(pullZ)}};
}

void densitySums(const SkinCells& cells, float reach, std::size_t first, std::span<DensitySum> sums) {
    thread_local Neighborhood neighborhood;
    std::size_t end = 0;  // of the cell whose neighborhood has been gathered
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const std::size_t place = first + k;
        const glm::vec4 particle(cells.x[place], cells.y[place], cells.z[place], cells.radius[place]);
        if (place >= end) {
            const glm::ivec3 cell = cells.cellOf(particle);
            gather(cells, cell, neighborhood);
            end = cells.begin[cells.cellIndex(cell.x, cell.y, cell.z) + 1];
        }
        sums[k] = sumOver(neighborhood, particle, reach);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace render {

HWY_EXPORT(densitySums);

void densitySums(const SkinCells& cells, float reach, std::size_t first, std::span<DensitySum> sums) {
    HWY_DYNAMIC_DISPATCH(densitySums)(cells, reach, first, sums);
}

}  // namespace render

#endif
