// The order of convergence that measured errors show.
#pragma once

#include <optional>
#include <vector>

namespace studies {

struct StepError {
    double step = 0.0;   ///< s
    double error = 0.0;  ///< any unit
};

/// Slope of log error over log step by least squares; nothing with fewer than two different steps.
/// Shape:  steps and errors > 0.
std::optional<double> fittedOrder(const std::vector<StepError>& points);

}  // namespace studies
