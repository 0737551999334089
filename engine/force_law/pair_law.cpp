// The random separation that is used in place of P where two particles coincide.
#include "engine/force_law/pair_law.h"

#include "engine/core/random.h"

namespace engine {

Vec3 coincidentSeparation(std::uint32_t idP, std::uint32_t idI, double restLength) {
    // The direction is that of a random point in a cube. Directions of the cube's diagonals are a little more likely
    // than those of its axes, which does not matter here.
    const Vec3 direction = randomVector(std::min(idP, idI), std::max(idP, idI));
    const double lengthSq = squaredLength(direction);
    if (lengthSq == 0.0) return Vec3::Zero();
    const double sign = idP < idI ? 1.0 : -1.0;
    return sign * kCoincidentShare * restLength / std::sqrt(lengthSq) * direction;
}

}  // namespace engine
