// Packing what was chosen of four in a row to the front, by table. Used by the list search.
#pragma once

#include <array>
#include <cstdint>

namespace engine {

inline constexpr unsigned kQuad = 4;

/// The numbers of the chosen ones, in order; what follows them means nothing.
using Packing = std::array<std::uint32_t, kQuad>;

constexpr std::array<Packing, 1U << kQuad> packings() {
    std::array<Packing, 1U << kQuad> all{};
    for (unsigned chosen = 0; chosen < all.size(); ++chosen) {
        std::size_t found = 0;
        for (unsigned k = 0; k < kQuad; ++k)
            if (((chosen >> k) & 1U) != 0) all[chosen][found++] = k;
    }
    return all;
}

/// By the bits of the chosen ones.
inline constexpr auto kPackings = packings();

}  // namespace engine
