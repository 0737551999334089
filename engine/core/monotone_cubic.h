// Monotone piecewise cubic interpolation (PCHIP) of several numbers at a time. A natural spline would be smoother in
// its second derivative, but overshoots its keys: a camera would dip into the ground, a gate go through its frame.
// Fritsch and Butland 1984, A Method for Constructing Local Monotone Piecewise Cubic Interpolants.
#pragma once

#include <array>
#include <cstddef>

namespace engine {

/// Values of a path at a time, and their first derivatives.
template <std::size_t n>
struct PathPoint {
    std::array<double, n> values{};
    std::array<double, n> slopes{};  ///< 1/s
};

/// The derivatives at a key of a path: zero at the ends of the path, where it is at rest, and for a number that has an
/// extremum at the key; otherwise the weighted harmonic mean of the slopes to the keys before and after. The mean is at
/// most three times the smaller slope, which keeps the cubics on both sides monotone.
template <std::size_t n, class TimeOf, class ValuesOf>
std::array<double, n> slopesAtKey(std::size_t count, std::size_t key, const TimeOf& timeOf, const ValuesOf& valuesOf) {
    std::array<double, n> slopes{};
    if (key == 0 || key + 1 == count) return slopes;
    const double before = timeOf(key) - timeOf(key - 1);
    const double after = timeOf(key + 1) - timeOf(key);
    const std::array<double, n> from = valuesOf(key - 1);
    const std::array<double, n> here = valuesOf(key);
    const std::array<double, n> to = valuesOf(key + 1);
    for (std::size_t k = 0; k < n; ++k) {
        const double left = (here[k] - from[k]) / before;
        const double right = (to[k] - here[k]) / after;
        const double leftWeight = before + 2.0 * after;
        const double rightWeight = after + 2.0 * before;
        // Each slope is compared with zero by itself, because the product of two small slopes may underflow.
        if ((left > 0.0 && right > 0.0) || (left < 0.0 && right < 0.0))
            slopes[k] = (leftWeight + rightWeight) / (leftWeight / left + rightWeight / right);
    }
    return slopes;
}

/// A path of n numbers at a time: values and first derivatives are continuous, no value leaves the interval between its
/// values at the two keys around it, and before the first and after the last key all stay as they are there.
/// @param count     of keys, at least 1
/// @param timeOf    timeOf(key) is the time of a key; increasing
/// @param valuesOf  valuesOf(key) are the numbers at a key, an array
template <std::size_t n, class TimeOf, class ValuesOf>
PathPoint<n> pathAt(std::size_t count, double time, const TimeOf& timeOf, const ValuesOf& valuesOf) {
    std::size_t next = 0;
    while (next < count && timeOf(next) <= time) ++next;
    if (next == 0) return {valuesOf(0), {}};
    if (next == count) return {valuesOf(count - 1), {}};
    const double length = timeOf(next) - timeOf(next - 1);
    const double u = (time - timeOf(next - 1)) / length;
    const std::array<double, n> from = valuesOf(next - 1);
    const std::array<double, n> to = valuesOf(next);
    const std::array<double, n> slopesFrom = slopesAtKey<n>(count, next - 1, timeOf, valuesOf);
    const std::array<double, n> slopesTo = slopesAtKey<n>(count, next, timeOf, valuesOf);
    PathPoint<n> point;
    // The Hermite cubic, written such that a number which is the same at both keys keeps its bits.
    for (std::size_t k = 0; k < n; ++k) {
        const double a = slopesFrom[k];
        const double b = slopesTo[k];
        point.values[k] =
            from[k] + (to[k] - from[k]) * (u * u * (3.0 - 2.0 * u)) + length * u * (1.0 - u) * ((1.0 - u) * a - u * b);
        point.slopes[k] = (to[k] - from[k]) / length * (6.0 * u * (1.0 - u)) + a * (1.0 - u) * (1.0 - 3.0 * u) -
                          b * u * (2.0 - 3.0 * u);
    }
    return point;
}

}  // namespace engine
