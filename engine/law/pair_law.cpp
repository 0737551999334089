// The random separation that is used in place of P where two particles coincide.
#include "engine/law/pair_law.h"

#include "engine/core/random.h"

namespace engine {

std::array<double, 3> coincidentSeparation(std::uint32_t idP, std::uint32_t idI, double restLength) {
    const std::uint64_t low = std::min(idP, idI);
    const std::uint64_t high = std::max(idP, idI);
    std::array<double, 3> direction{};
    double lengthSq = 0.0;
    for (std::uint64_t component = 0; component < 3; ++component) {
        direction[component] = symmetricUnit(randomBits(low, high, component));
        lengthSq += direction[component] * direction[component];
    }
    // The direction is that of a random point in a cube. Directions of the cube's diagonals are a little more likely
    // than those of its axes, which does not matter here.
    const double sign = idP < idI ? 1.0 : -1.0;
    const double scale = lengthSq > 0.0 ? sign * kCoincidentShare * restLength / std::sqrt(lengthSq) : 0.0;
    for (double& component : direction) component *= scale;
    return direction;
}

}  // namespace engine
