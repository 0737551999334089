// Fits power laws to measured points, for an order of convergence or for the growth of a time with the number of
// particles, and reads the cost of a given error off a Pareto front. Used by the studies of accuracy and scaling.
#pragma once

#include <optional>
#include <vector>

namespace studies {

/// A measured pair of two quantities, in any units.
struct PowerLawPoint {
    double x = 0.0;  ///< for example a step or a number of particles, > 0
    double y = 0.0;  ///< for example an error or a time, > 0
};

/// The exponent k of y ~ x^k by least squares of the logarithms; nothing with fewer than two different x.
std::optional<double> powerLawExponent(const std::vector<PowerLawPoint>& points);

/// Error and cost of one run of a method.
struct CostPoint {
    double error = 0.0;  ///< error in any unit, > 0
    double cost = 0.0;   ///< cost in any unit, > 0
};

/// The least cost at which a method reaches an error, read off the Pareto front of its runs: points that another point
/// beats in both error and cost are dropped, and between neighbors on the front log cost is linear in log error.
/// @param points  in any order
/// @return  nothing if every point has a larger error, the cheapest point's cost if every point has a smaller one
std::optional<double> costAt(const std::vector<CostPoint>& points, double error);

}  // namespace studies
