// Blocks of 128 bits, of which vectors are put together: loads of this kind and shuffles of blocks take half of the
// time of gathers. Included once per instruction set, by Highway's rules; the guard below is theirs.
#if defined(ENGINE_SIMD_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_BLOCKS_INL_H
#undef ENGINE_SIMD_BLOCKS_INL_H
#else
#define ENGINE_SIMD_BLOCKS_INL_H
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/neighbors/neighbor_rows.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::CappedTag<T, kClusterSize>;
template <class T>
using Lanes = hn::Vec<Tag<T>>;
template <class T>
using Indices = hn::Vec<hn::Rebind<std::int32_t, Tag<T>>>;  ///< as many as Lanes<T>

/// A bit a lane.
template <class T>
std::uint32_t bitsOf(hn::Mask<Tag<T>> mask) {
    std::array<std::uint8_t, 8> bytes = {};
    hn::StoreMaskBits(Tag<T>(), mask, bytes.data());
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
}

/// Fetches what stands some rows of a cluster ahead into the cache. A block's rows are read once a pass, and those of
/// many particles come from memory: processors that fetch ahead by themselves do so too late. Measured with `globular
/// bench
/// --filter forces` on Zen 5: a tenth less time at 256,000 particles, less at 32,000.
template <class Entry>
HWY_INLINE void fetchAhead(const Entry* row) {
    constexpr std::size_t kRows = 96;
    hwy::Prefetch(row + kRows * kClusterSize);
}

#if HWY_TARGET != HWY_SCALAR
/// Blocks of 128 bits side by side, as many as a vector has: of every so many sortedIndices one record's, at the base.
template <class D>
HWY_INLINE hn::Vec<D> blocksFrom(D d, const hn::TFromD<D>* base, std::int64_t stride, const std::int32_t* sortedIndices,
                                 std::size_t every) {
    constexpr std::size_t kBlocks = hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) / 16;
    if constexpr (kBlocks <= 1) {
        return hn::Load(d, base + stride * sortedIndices[0]);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, blocksFrom(half, base, stride, sortedIndices + every * kBlocks / 2, every),
                           blocksFrom(half, base, stride, sortedIndices, every));
    }
}
#endif

// Highway has no name for these. Masked forms, because gcc takes the others to read what nobody has set.
#if HWY_TARGET <= HWY_AVX3
/// Half a vector of each of two sortedIndices' packed, at the base: one load and one that inserts.
HWY_INLINE hn::Vec<Tag<float>> halvesFrom(const float* base, std::int64_t stride, std::int32_t low, std::int32_t high) {
    const __m512 lower = _mm512_castps256_ps512(_mm256_load_ps(base + stride * low));
    return hn::Vec<Tag<float>>{_mm512_maskz_insertf32x8(0xFFFF, lower, _mm256_load_ps(base + stride * high), 1)};
}

HWY_INLINE hn::Vec<Tag<double>> halvesFrom(const double* base, std::int64_t stride, std::int32_t low,
                                           std::int32_t high) {
    const __m512d lower = _mm512_castpd256_pd512(_mm256_load_pd(base + stride * low));
    return hn::Vec<Tag<double>>{_mm512_maskz_insertf64x4(0xFF, lower, _mm256_load_pd(base + stride * high), 1)};
}

/// Blocks of 128 bits of every other of eight sortedIndices' packed.
HWY_INLINE hn::Vec<Tag<double>> blocksOf(const double* base, std::int64_t stride, const std::int32_t* sortedIndices) {
    const auto block = [&](int at) { return _mm_load_pd(base + stride * sortedIndices[at]); };
    __m512d four = _mm512_castpd128_pd512(block(0));
    four = _mm512_mask_broadcast_f64x2(four, 0x0C, block(2));
    four = _mm512_mask_broadcast_f64x2(four, 0x30, block(4));
    return hn::Vec<Tag<double>>{_mm512_mask_broadcast_f64x2(four, 0xC0, block(6))};
}

/// Of two vectors of four blocks of 128 bits each the even ones, and the odd ones.
HWY_INLINE hn::Vec<Tag<float>> evenBlocks(hn::Vec<Tag<float>> a, hn::Vec<Tag<float>> b) {
    return hn::Vec<Tag<float>>{_mm512_maskz_shuffle_f32x4(0xFFFF, a.raw, b.raw, 0x88)};
}
HWY_INLINE hn::Vec<Tag<float>> oddBlocks(hn::Vec<Tag<float>> a, hn::Vec<Tag<float>> b) {
    return hn::Vec<Tag<float>>{_mm512_maskz_shuffle_f32x4(0xFFFF, a.raw, b.raw, 0xDD)};
}
HWY_INLINE hn::Vec<Tag<double>> evenBlocks(hn::Vec<Tag<double>> a, hn::Vec<Tag<double>> b) {
    return hn::Vec<Tag<double>>{_mm512_maskz_shuffle_f64x2(0xFF, a.raw, b.raw, 0x88)};
}
HWY_INLINE hn::Vec<Tag<double>> oddBlocks(hn::Vec<Tag<double>> a, hn::Vec<Tag<double>> b) {
    return hn::Vec<Tag<double>>{_mm512_maskz_shuffle_f64x2(0xFF, a.raw, b.raw, 0xDD)};
}
#endif

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
