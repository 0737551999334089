// Counts the pairs in a sample with a neighbor list: of 1 in n particles, 1 in n^2 pairs are found.
#include "engine/neighbors/pair_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/core/random.h"
#include "engine/neighbors/neighbor_list.h"

namespace engine {

std::uint64_t strideFor(double number, double most) {
    return static_cast<std::uint64_t>(std::max(1.0, std::ceil(number / most)));
}

std::vector<std::uint32_t> sampleOf(std::size_t count, std::uint64_t stride) {
    std::vector<std::uint32_t> sample;
    for (std::uint32_t p = 0; p < count; ++p)
        if (scatter(p) % stride == 0) sample.push_back(p);
    return sample;
}

double estimatePairCount(const std::vector<Vec3>& positions, std::span<const double> radii, double cutoff) {
    const std::uint64_t stride = strideFor(static_cast<double>(positions.size()), kPairSampleCount);
    std::vector<Vec3> chosen;
    std::vector<double> chosenRadii;
    for (const std::uint32_t p : sampleOf(positions.size(), stride)) {
        chosen.push_back(positions[p]);
        chosenRadii.push_back(radii[p]);
    }
    if (chosen.size() < 2 || cutoff == 0.0) return 0.0;
    const double share =
        *std::max_element(chosenRadii.begin(), chosenRadii.end()) / *std::max_element(radii.begin(), radii.end());
    NeighborList list;
    build(list, chosen, chosenRadii, share * cutoff, 0.0);
    return 0.5 * static_cast<double>(list.entryCount) * static_cast<double>(stride) * static_cast<double>(stride);
}

}  // namespace engine
