// slope = sum (x - mean x)(y - mean y) / sum (x - mean x)^2 with x = log step, y = log error.
#include "studies/common/order_fit.h"

#include <cmath>

namespace studies {

std::optional<double> fittedOrder(const std::vector<StepError>& points) {
    const auto count = static_cast<double>(points.size());
    double meanX = 0.0;
    double meanY = 0.0;
    for (const StepError& point : points) {
        meanX += std::log(point.step) / count;
        meanY += std::log(point.error) / count;
    }
    double xx = 0.0;
    double xy = 0.0;
    for (const StepError& point : points) {
        const double x = std::log(point.step) - meanX;
        xx += x * x;
        xy += x * (std::log(point.error) - meanY);
    }
    constexpr double kOneStep = 1e-18;  // spread of log steps that is rounding
    if (xx <= kOneStep) return std::nullopt;
    return xy / xx;
}

}  // namespace studies
