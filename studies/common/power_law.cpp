// Fits power laws by straight lines through logarithms. See power_law.h.
#include "studies/common/power_law.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

/// The points that no other point beats in both error and cost, in the order of rising cost and falling error.
std::vector<CostPoint> paretoFront(std::vector<CostPoint> points) {
    std::sort(points.begin(), points.end(), [](const CostPoint& a, const CostPoint& b) {
        return a.cost < b.cost || (a.cost == b.cost && a.error < b.error);
    });
    std::vector<CostPoint> front;
    for (const CostPoint& point : points)
        if (front.empty() || point.error < front.back().error) front.push_back(point);
    return front;
}

/// The cost of an error that lies between the errors of two neighbors on the Pareto front, by log-log interpolation.
double interpolatedCost(const CostPoint& cheap, const CostPoint& expensive, double error) {
    const double share = std::log(error / cheap.error) / std::log(expensive.error / cheap.error);
    return cheap.cost * std::pow(expensive.cost / cheap.cost, share);
}

}  // namespace

// With u = log x and v = log y, k = sum (u - mean u)(v - mean v) / sum (u - mean u)^2.
std::optional<double> powerLawExponent(const std::vector<PowerLawPoint>& points) {
    const auto count = static_cast<double>(points.size());
    double meanU = 0.0;
    double meanV = 0.0;
    for (const PowerLawPoint& point : points) {
        meanU += std::log(point.x) / count;
        meanV += std::log(point.y) / count;
    }
    double uu = 0.0;
    double uv = 0.0;
    for (const PowerLawPoint& point : points) {
        const double u = std::log(point.x) - meanU;
        uu += u * u;
        uv += u * (std::log(point.y) - meanV);
    }
    constexpr double kRounding = 1e-18;  // chosen: above the square of rounding errors of logarithms, 1e-16
    if (uu <= kRounding) return std::nullopt;
    return uv / uu;
}

std::optional<double> costAt(const std::vector<CostPoint>& points, double error) {
    const std::vector<CostPoint> front = paretoFront(points);
    for (std::size_t k = 0; k < front.size(); ++k)
        if (front[k].error <= error) return k == 0 ? front[0].cost : interpolatedCost(front[k - 1], front[k], error);
    return std::nullopt;
}

}  // namespace studies
