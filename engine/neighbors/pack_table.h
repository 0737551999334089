// Packing what was chosen of eight in a row to the front, by table. Used by the list search.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace engine {

inline constexpr std::size_t kPacked = 8;

/// The numbers of the chosen ones, in order; what follows them means nothing.
using Packing = std::array<std::uint8_t, kPacked>;

constexpr std::array<Packing, 1U << kPacked> packings() {
    std::array<Packing, 1U << kPacked> all{};
    for (std::size_t chosen = 0; chosen < all.size(); ++chosen) {
        std::size_t found = 0;
        for (std::uint8_t k = 0; k < kPacked; ++k)
            if (((chosen >> k) & 1U) != 0) all[chosen][found++] = k;
    }
    return all;
}

/// By the bits of the chosen ones.
inline constexpr auto kPackings = packings();

}  // namespace engine
