// Sums that are the same bits on every instruction set: they run over blocks of 16 numbers with 16 accumulators,
// however wide the vectors are, which are added up in a fixed order. Included by Highway's rules, from which the guard
// below comes.
#if defined(RENDER_SIMD_SUMS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_SUMS_INL_H_
#undef RENDER_SIMD_SUMS_INL_H_
#else
#define RENDER_SIMD_SUMS_INL_H_
#endif

#include <array>
#include <cstddef>

#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

#ifndef RENDER_SIMD_SUMS
#define RENDER_SIMD_SUMS
namespace render {

/// Number of items, such as kernels, that are added up at a time.
constexpr std::size_t kBlock = 16;

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr std::size_t kVectorsPerBlock = kBlock / hn::MaxLanes(D());
using BlockSum = std::array<V, kVectorsPerBlock>;

/// The sum of all accumulators: the second half is added to the first until one is left.
HWY_INLINE float total(const BlockSum& sum) {
    const hn::CappedTag<float, 4> d;
    alignas(64) std::array<float, kBlock> sums;
    for (std::size_t v = 0; v < kVectorsPerBlock; ++v) store(sum[v], &sums[v * hn::Lanes(D())]);
    for (const std::size_t half : {std::size_t{8}, std::size_t{4}})
        for (std::size_t k = 0; k < half; k += hn::Lanes(d))
            hn::Store(hn::Load(d, &sums[k]) + hn::Load(d, &sums[k + half]), d, &sums[k]);
    return (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
