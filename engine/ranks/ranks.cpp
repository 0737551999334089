// A run in one process, and reductions of single values.
#include "engine/ranks/ranks.h"

#include <array>
#include <cmath>
#include <limits>

namespace engine {

const Ranks& Ranks::alone() {
    static const Ranks ranks;
    return ranks;
}

bool holdsOnAll(const Ranks& ranks, bool holds) {
    return largestOfAll(ranks, holds ? 0.0 : 1.0) == 0.0;
}

double largestOfAll(const Ranks& ranks, double number) {
    ranks.maximize({&number, 1});
    return number;
}

BoundingBox overRanks(const Ranks& ranks, BoundingBox box) {
    if (!ranks.areMany()) return box;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 6> bounds;  // the lower ones with a minus, for maximize()
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        bounds.at(axis) = std::isnan(box.low[at]) ? kInfinity : -box.low[at];
        bounds.at(axis + 3) = std::isnan(box.high[at]) ? kInfinity : box.high[at];
    }
    ranks.maximize(bounds);
    return {{-bounds[0], -bounds[1], -bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
}

std::uint64_t sumOfAll(const Ranks& ranks, std::uint64_t number) {
    auto sum = static_cast<std::int64_t>(number);
    ranks.sum({&sum, 1});
    return static_cast<std::uint64_t>(sum);
}

}  // namespace engine
