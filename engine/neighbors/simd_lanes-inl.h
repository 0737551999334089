// The vector types of the kernels over neighbor rows: as many lanes as the instruction set has, at most kClusterSize.
// Highway includes this file once per instruction set, hence the unusual include guard below.
#if defined(ENGINE_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_LANES_INL_H
#undef ENGINE_SIMD_LANES_INL_H
#else
#define ENGINE_SIMD_LANES_INL_H
#endif

#include <hwy/highway.h>

#include <array>
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

/// Converts a SIMD mask to one bit for each lane.
template <class T>
std::uint32_t bitsOf(hn::Mask<Tag<T>> mask) {
    std::array<std::uint8_t, 8> bytes = {};
    hn::StoreMaskBits(Tag<T>(), mask, bytes.data());
    return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
