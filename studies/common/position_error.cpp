// Distances in order of birth.
#include "studies/common/position_error.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "studies/common/infinity.h"

namespace studies {
bool sameBirths(const engine::Particles& a, const engine::Particles& b) {
    constexpr double kSameTime = 1e-9;  // rounding of a time, s
    if (a.count() != b.count()) return false;
    for (std::size_t p = 0; p < a.count(); ++p)
        if (a.material[p] != b.material[p] || std::abs(a.birthTime[p] - b.birthTime[p]) > kSameTime) return false;
    return true;
}

PositionError positionError(const engine::Particles& particles, const engine::Particles& reference,
                            std::size_t common) {
    PositionError error;
    const bool isSame = sameBirths(particles, reference);
    error.compared = isSame ? particles.count() : common;
    if (error.compared == 0) return isSame ? error : PositionError{kInfinity, kInfinity, 0};
    double sumSq = 0.0;
    double largestSq = 0.0;
    for (std::size_t p = 0; p < error.compared; ++p) {
        const double radius = reference.radius[p];
        const double squared = engine::squaredLength(particles.position[p] - reference.position[p]) / (radius * radius);
        sumSq += squared;
        largestSq = std::max(largestSq, squared);
    }
    error.rms = std::sqrt(sumSq / static_cast<double>(error.compared));
    error.largest = std::sqrt(largestSq);
    return error;
}

engine::Particles displaced(engine::Particles particles, double radii) {
    constexpr std::uint64_t kSeed = 1;
    for (std::size_t p = 0; p < particles.count(); ++p)
        for (int axis = 0; axis < 3; ++axis)
            particles.position[p][axis] +=
                radii * particles.radius[p] *
                engine::symmetricUnit(engine::randomBits(kSeed, p, static_cast<std::uint64_t>(axis)));
    return particles;
}

}  // namespace studies
