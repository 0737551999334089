// Compiled once per instruction set. Four lanes at a time: what Highway interleaves are blocks of a row of the group.
#include "engine/lane_layout.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/lane_layout.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<std::uint32_t, kRowPadding> kPlaces{};
constexpr std::size_t kBlock = 4;

void interleaveHere(const GroupRows& rows, std::uint32_t longest, std::int32_t* to) {
    const auto step = static_cast<std::uint32_t>(hn::Lanes(kPlaces));
    for (std::size_t first = 0; first < kGroup; first += kBlock) {
        for (std::uint32_t k = 0; k < longest; k += step) {
            // Beyond the end of a row its padding goes on.
            const auto lane = [&](std::size_t of) {
                return hn::LoadU(kPlaces, rows.row[first + of] + std::min(k, rows.length[first + of]));
            };
            std::array<std::uint32_t, kBlock * kRowPadding> blocks;
            hn::StoreInterleaved4(lane(0), lane(1), lane(2), lane(3), kPlaces, blocks.data());
            const std::uint32_t end = std::min(step, longest - k);
            for (std::uint32_t of = 0; of < end; ++of)
                std::memcpy(to + (k + of) * kGroup + first, &blocks[of * kBlock], kBlock * sizeof(std::uint32_t));
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(interleaveHere);

void interleave(const GroupRows& rows, std::uint32_t longest, std::int32_t* to) {
    HWY_DYNAMIC_DISPATCH(interleaveHere)(rows, longest, to);
}

}  // namespace engine

#endif
