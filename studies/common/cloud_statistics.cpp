// Sums in order of birth, shares by selection.
#include "studies/common/cloud_statistics.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

/// The smallest of the values that at least 90 % of them do not exceed.
double ninetieth(std::vector<double> values) {
    const std::size_t rank = (9 * values.size() + 9) / 10 - 1;
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return *place;
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
    statistics.r90 = ninetieth(std::move(distances));
    statistics.z90 = ninetieth(std::move(heights));
    return statistics;
}

double largestDifference(const BulkStatistics& a, const BulkStatistics& b) {
    return std::max({std::sqrt(engine::squaredLength(a.center - b.center)), std::abs(a.gyration - b.gyration),
                     std::abs(a.r90 - b.r90), std::abs(a.z90 - b.z90)});
}

}  // namespace studies
