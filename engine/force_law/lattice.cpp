// Counts the points of the face-centered cubic lattice by their distance from one of them.
#include "engine/force_law/lattice.h"

namespace engine {

const std::array<double, kShellCount + 1>& shellSizes() {
    static const std::array<double, kShellCount + 1> sizes = [] {
        // In units of half the cube's edge, the points are those with an even sum of coordinates, and their squared
        // distance is 2 n.
        std::array<double, kShellCount + 1> counted{};
        const int most = static_cast<int>(std::sqrt(2.0 * kShellCount));
        for (int x = -most; x <= most; ++x)
            for (int y = -most; y <= most; ++y)
                for (int z = -most; z <= most; ++z)
                    if (const int square = x * x + y * y + z * z; square % 2 == 0 && square <= 2 * kShellCount)
                        counted[static_cast<std::size_t>(square / 2)] += 1.0;
        return counted;
    }();
    return sizes;
}

}  // namespace engine
