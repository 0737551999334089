// Loads of several consecutive numbers for each SIMD lane, each lane from an index of its own. One load of 128 bits per
// lane and a transposition take less time than one gather instruction per number (measured: 4 ns against 19 ns for four
// numbers in each of 16 lanes of AVX-512). Included once per instruction set by Highway's rules, from which the guard
// below comes.
#if defined(RENDER_SIMD_LOADS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_SIMD_LOADS_INL_H_
#undef RENDER_SIMD_LOADS_INL_H_
#else
#define RENDER_SIMD_LOADS_INL_H_
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <hwy/highway.h>

#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Four numbers per lane.
struct Float4 {
    V x, y, z, w;
};

#if HWY_TARGET != HWY_SCALAR
/// Loads 128 bits from each of the indices 0, 4, 8, ... of an array of indices, one after another, into one vector.
template <class Tag, class Number>
HWY_INLINE hn::Vec<Tag> loadEveryFourth(Tag tag, const Number* numbers, const std::int32_t* indices) {
    constexpr std::size_t kBlocks = hn::MaxLanes(Tag()) * sizeof(Number) / 16;
    if constexpr (kBlocks <= 1) {
        return hn::LoadU(tag, numbers + indices[0]);
    } else {
        const hn::Half<Tag> half;
        return hn::Combine(tag, loadEveryFourth(half, numbers, indices + 2 * kBlocks),
                           loadEveryFourth(half, numbers, indices));
    }
}

/// For each lane the 128 bits from the lane's index on: four floats, or four pairs of 16-bit numbers.
template <class Number>
HWY_INLINE Float4 gatherBlocks(const Number* numbers, VI indices) {
    const DI di;
    const D d;
    alignas(64) std::array<std::int32_t, kTileSize> at;
    hn::Store(indices, di, at.data());
    const hn::Repartition<Number, D> tag;
    const hn::Repartition<double, D> twos;  // for moving two floats at a time
    const auto from = [&](std::size_t lane) { return hn::BitCast(d, loadEveryFourth(tag, numbers, at.data() + lane)); };
    const auto lower = [&](V p, V q) { return hn::BitCast(twos, hn::InterleaveLower(d, p, q)); };
    const auto upper = [&](V p, V q) { return hn::BitCast(twos, hn::InterleaveUpper(d, p, q)); };
    const V a = from(0), b = from(1), c = from(2), e = from(3);
    const auto xy = lower(a, b), nextXy = lower(c, e), zw = upper(a, b), nextZw = upper(c, e);
    return {
        hn::BitCast(d, hn::InterleaveLower(twos, xy, nextXy)), hn::BitCast(d, hn::InterleaveUpper(twos, xy, nextXy)),
        hn::BitCast(d, hn::InterleaveLower(twos, zw, nextZw)), hn::BitCast(d, hn::InterleaveUpper(twos, zw, nextZw))};
}
#endif

/// For each lane the four numbers from the lane's index on.
HWY_INLINE Float4 gather4(const float* numbers, VI indices) {
#if HWY_TARGET == HWY_SCALAR
    const float* four = numbers + hn::GetLane(indices);
    return {splat(four[0]), splat(four[1]), splat(four[2]), splat(four[3])};
#else
    return gatherBlocks(numbers, indices);
#endif
}

/// For each lane the six numbers from the lane's index on.
/// @pre two more numbers follow them, which are read as well
HWY_INLINE std::array<VI, 6> gather6(const std::uint16_t* numbers, VI indices) {
#if HWY_TARGET == HWY_SCALAR
    const std::uint16_t* six = numbers + hn::GetLane(indices);
    return {splatInt(six[0]), splatInt(six[1]), splatInt(six[2]), splatInt(six[3]), splatInt(six[4]), splatInt(six[5])};
#else
    const DI di;
    const Float4 pairs = gatherBlocks(numbers, indices);
    const hn::RebindToUnsigned<D> du;
    const auto first = [&](V pair) { return hn::And(hn::BitCast(di, pair), splatInt(0xffff)); };
    const auto second = [&](V pair) { return hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(du, pair))); };
    return {first(pairs.x), second(pairs.x), first(pairs.y), second(pairs.y), first(pairs.z), second(pairs.z)};
#endif
}

/// A record of four 32-bit integers for each lane.
struct Words {
    VI x, y, z, w;
};

/// For each lane the record at the lane's index.
template <typename Record>
HWY_INLINE Words loadRecords(std::span<const Record> records, VI index) {
    static_assert(sizeof(Record) == 4 * sizeof(float));
    const Float4 four = gather4(reinterpret_cast<const float*>(records.data()), hn::ShiftLeft<2>(index));
    const DI di;
    return {hn::BitCast(di, four.x), hn::BitCast(di, four.y), hn::BitCast(di, four.z), hn::BitCast(di, four.w)};
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
