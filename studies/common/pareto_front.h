// The front of error against cost of one stepper, read between its measured points: what would this error have cost?
#pragma once

#include <optional>
#include <vector>

namespace studies {

struct CostPoint {
    double error = 0.0;
    double cost = 0.0;
};

/// Least cost at which an error no larger than the given one is had.
/// Shape:  errors and costs > 0, in any order; a point that another beats in both does not count. Between points of
///         the front log cost is linear in log error.
/// Returns nothing where every point errs more; the cheapest point's cost where every point errs less.
std::optional<double> costAt(const std::vector<CostPoint>& points, double error);

}  // namespace studies
