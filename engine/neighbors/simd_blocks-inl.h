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

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
