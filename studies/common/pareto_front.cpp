// Sort by cost, keep what improves, interpolate.
#include "studies/common/pareto_front.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

/// Rising cost, falling error.
std::vector<CostPoint> frontOf(std::vector<CostPoint> points) {
    std::sort(points.begin(), points.end(), [](const CostPoint& a, const CostPoint& b) {
        return a.cost < b.cost || (a.cost == b.cost && a.error < b.error);
    });
    std::vector<CostPoint> front;
    for (const CostPoint& point : points)
        if (front.empty() || point.error < front.back().error) front.push_back(point);
    return front;
}

double between(const CostPoint& cheap, const CostPoint& dear, double error) {
    const double share = std::log(error / cheap.error) / std::log(dear.error / cheap.error);
    return cheap.cost * std::pow(dear.cost / cheap.cost, share);
}

}  // namespace

std::optional<double> costAt(const std::vector<CostPoint>& points, double error) {
    const std::vector<CostPoint> front = frontOf(points);
    for (std::size_t k = 0; k < front.size(); ++k)
        if (front[k].error <= error) return k == 0 ? front[0].cost : between(front[k - 1], front[k], error);
    return std::nullopt;
}

}  // namespace studies
