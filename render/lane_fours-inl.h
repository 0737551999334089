// Four numbers from a place of each lane: loads of 128 bits and shuffles take less time than as many gathers.
// Included once per instruction set, by Highway's rules; the guard below is theirs.
#if defined(RENDER_LANE_FOURS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_LANE_FOURS_INL_H_
#undef RENDER_LANE_FOURS_INL_H_
#else
#define RENDER_LANE_FOURS_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/lane_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

struct Fours {
    V x, y, z, w;
};

#if HWY_TARGET != HWY_SCALAR
/// Four numbers of every fourth lane, block by block.
template <class Tag>
HWY_INLINE hn::Vec<Tag> everyFourth(Tag tag, const float* numbers, const std::int32_t* places) {
    constexpr std::size_t kLanes = hn::MaxLanes(Tag());
    if constexpr (kLanes <= 4) {
        return hn::LoadU(tag, numbers + places[0]);
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(tag, everyFourth(half, numbers, places + kLanes / 2), everyFourth(half, numbers, places));
    }
}
#endif

/// Shape:  numbers from each place on, of which there are four and more.
HWY_INLINE Fours foursFrom(const float* numbers, VI places) {
    const DI di;
    alignas(64) std::array<std::int32_t, kTileSize> at;
    hn::Store(places, di, at.data());
#if HWY_TARGET == HWY_SCALAR
    const float* four = numbers + at[0];
    return {all(four[0]), all(four[1]), all(four[2]), all(four[3])};
#else
    const D d;
    const hn::Repartition<double, D> twos;
    const auto from = [&](std::size_t lane) { return everyFourth(d, numbers, at.data() + lane); };
    const auto lower = [&](V p, V q) { return hn::BitCast(twos, hn::InterleaveLower(d, p, q)); };
    const auto upper = [&](V p, V q) { return hn::BitCast(twos, hn::InterleaveUpper(d, p, q)); };
    const V a = from(0), b = from(1), c = from(2), e = from(3);
    const auto xy = lower(a, b), nextXy = lower(c, e), zw = upper(a, b), nextZw = upper(c, e);
    return {
        hn::BitCast(d, hn::InterleaveLower(twos, xy, nextXy)), hn::BitCast(d, hn::InterleaveUpper(twos, xy, nextXy)),
        hn::BitCast(d, hn::InterleaveLower(twos, zw, nextZw)), hn::BitCast(d, hn::InterleaveUpper(twos, zw, nextZw))};
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
