// Compiled once per instruction set. Four words of a row at a time: what Highway interleaves are blocks of a row of the
// cluster.
#include "engine/neighbors/row_layout.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/neighbors/row_layout.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<std::uint32_t, kRowPadding> kPlaces{};
constexpr std::size_t kBlock = 4;

/// Shape:  columns: words of each row; word(column, k): those of entries from k on.
template <class Word>
void interleaveWords(std::size_t columns, std::uint32_t longest, const Word& word, void* to) {
    const auto step = static_cast<std::uint32_t>(hn::Lanes(kPlaces));
    const std::size_t stride = columns * sizeof(std::uint32_t);
    for (std::size_t first = 0; first < columns; first += kBlock) {
        for (std::uint32_t k = 0; k < longest; k += step) {
            std::array<std::uint32_t, kBlock * kRowPadding> blocks;
            hn::StoreInterleaved4(word(first, k), word(first + 1, k), word(first + 2, k), word(first + 3, k), kPlaces,
                                  blocks.data());
            const std::uint32_t end = std::min(step, longest - k);
            std::byte* row = static_cast<std::byte*>(to) + k * stride + first * sizeof(std::uint32_t);
            for (std::uint32_t of = 0; of < end; ++of, row += stride)
                std::memcpy(row, &blocks[of * kBlock], kBlock * sizeof(std::uint32_t));
        }
    }
}

/// Entries of a lane from one on. Beyond the end of a row its padding goes on.
HWY_INLINE hn::Vec<decltype(kPlaces)> entriesOfLane(const ClusterRows& rows, std::uint32_t base, std::size_t lane,
                                                    std::uint32_t k) {
    const auto sortedIndices = hn::LoadU(kPlaces, rows.row[lane] + std::min(k, rows.length[lane]));
    return hn::Sub(sortedIndices, hn::Set(kPlaces, base));
}

void interleaveWideHere(const ClusterRows& rows, std::uint32_t base, std::int32_t* to) {
    const auto oneLane = [&](std::size_t column, std::uint32_t k) { return entriesOfLane(rows, base, column, k); };
    interleaveWords(kClusterSize, rows.longest, oneLane, to);
}

static_assert(std::endian::native == std::endian::little);

/// The half words of two lanes are a word.
void interleaveNarrowHere(const ClusterRows& rows, std::uint32_t base, std::uint16_t* to) {
    const auto twoLanes = [&](std::size_t column, std::uint32_t k) {
        const auto odd = entriesOfLane(rows, base, 2 * column + 1, k);
        return hn::Or(entriesOfLane(rows, base, 2 * column, k), hn::ShiftLeft<16>(odd));
    };
    interleaveWords(kClusterSize / 2, rows.longest, twoLanes, to);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(interleaveWideHere);
HWY_EXPORT(interleaveNarrowHere);

void interleave(const ClusterRows& rows, std::uint32_t base, std::int32_t* to) {
    HWY_DYNAMIC_DISPATCH(interleaveWideHere)(rows, base, to);
}

void interleave(const ClusterRows& rows, std::uint32_t base, std::uint16_t* to) {
    HWY_DYNAMIC_DISPATCH(interleaveNarrowHere)(rows, base, to);
}

}  // namespace engine

#endif
