// Compares the particles of two states by sums over all particles in order of birth. See state_difference.h.
#include "studies/common/state_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/random.h"

namespace studies {
namespace {

/// The smallest of the values that at least 90 % of them do not exceed.
double ninetiethPercentile(std::vector<double> values) {
    const std::size_t rank = (9 * values.size() + 9) / 10 - 1;
    const auto position = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), position, values.end());
    return *position;
}

}  // namespace

BulkStatistics bulkStatistics(const engine::Particles& particles) {
    BulkStatistics statistics;
    if (particles.count() == 0) return statistics;
    double mass = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        mass += particles.mass[p];
        statistics.center += particles.mass[p] * particles.position[p];
    }
    statistics.center /= mass;

    double spread = 0.0;
    std::vector<double> distances;
    std::vector<double> heights;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const double squared = engine::squaredLength(particles.position[p] - statistics.center);
        spread += particles.mass[p] * squared;
        distances.push_back(std::sqrt(squared));
        heights.push_back(particles.position[p].y());
    }
    statistics.gyration = std::sqrt(spread / mass);
    statistics.r90 = ninetiethPercentile(std::move(distances));
    statistics.z90 = ninetiethPercentile(std::move(heights));
    return statistics;
}

double largestDifference(const BulkStatistics& a, const BulkStatistics& b) {
    return std::max({std::sqrt(engine::squaredLength(a.center - b.center)), std::abs(a.gyration - b.gyration),
                     std::abs(a.r90 - b.r90), std::abs(a.z90 - b.z90)});
}

bool sameBirths(const engine::Particles& a, const engine::Particles& b) {
    constexpr double kSameTime = 1e-9;  // tolerance of birth times, s; chosen: far above rounding, far below a step
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
        particles.position[p] += radii * particles.radius[p] * engine::randomVector(kSeed, p);
    return particles;
}

MomentumScale momentumScale(const engine::Particles& particles) {
    MomentumScale scale;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const engine::Vec3 momentum = particles.mass[p] * particles.velocity[p];
        scale.linear += momentum.norm();
        scale.angular += particles.position[p].cross(momentum).norm();
    }
    return scale;
}

}  // namespace studies
