// Real roots of polynomials up to degree four inside an interval, for the oracle's metaballs. Between two neighboring
// roots of its derivative a polynomial is monotone, so it has at most one root there, which bisection finds. The roots
// of the derivative are found in the same way, beginning with the derivative that is linear. Header only.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace oracle {

/// The coefficients of c[0] + c[1] x + ... + c[4] x^4.
using Quartic = std::array<double, 5>;

inline double valueAt(const Quartic& c, double x) {
    return (((c[4] * x + c[3]) * x + c[2]) * x + c[1]) * x + c[0];
}

inline Quartic derivative(const Quartic& c) {
    return {c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 0.0};
}

/// The root of a polynomial between two points where it has opposite signs, by bisection. It is exact to the last bit,
/// as far as the signs of the computed values are right.
inline double bisect(const Quartic& c, double low, double high) {
    const bool risesFromLow = valueAt(c, low) < 0.0;
    while (true) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return middle;  // no double lies between low and high
        const double value = valueAt(c, middle);
        if (value == 0.0) return middle;
        ((value < 0.0) == risesFromLow ? low : high) = middle;
    }
}

/// The roots of a polynomial at some points and between them, ascending.
/// @param knots  the points, ascending; the polynomial must be monotone between neighbors
inline std::vector<double> rootsBetweenKnots(const Quartic& c, const std::vector<double>& knots) {
    std::vector<double> roots;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        const double here = valueAt(c, knots[i]);
        if (here == 0.0) {
            if (roots.empty() || roots.back() != knots[i]) roots.push_back(knots[i]);
        } else if (i + 1 < knots.size()) {
            const double next = valueAt(c, knots[i + 1]);
            if ((here < 0.0 && next > 0.0) || (here > 0.0 && next < 0.0))
                roots.push_back(bisect(c, knots[i], knots[i + 1]));
        }
    }
    return roots;
}

/// A quick test whether a polynomial is negative in all of [-1, 1]: true proves it, false proves nothing. With
/// s = 2 t - 1 and t in [0, 1] the value at s is a weighted mean of five coefficients in the Bernstein basis, so it is
/// negative if all of them are.
inline bool staysNegative(const Quartic& c) {
    // The coefficients q of the powers of t in c(2 t - 1), by Horner's rule: q <- q (2 t - 1) + c[k].
    Quartic q{};
    for (std::size_t k = c.size(); k-- > 0;) {
        for (std::size_t power = q.size() - 1; power > 0; --power) q[power] = 2.0 * q[power - 1] - q[power];
        q[0] = c[k] - q[0];
    }
    // The coefficients in the Bernstein basis: b_k = sum over j <= k of (k choose j) / (4 choose j) q_j.
    const double b1 = q[0] + q[1] / 4.0;
    const double b2 = q[0] + q[1] / 2.0 + q[2] / 6.0;
    const double b3 = q[0] + 3.0 * q[1] / 4.0 + q[2] / 2.0 + q[3] / 4.0;
    const double b4 = q[0] + q[1] + q[2] + q[3] + q[4];
    // A margin for the rounding of about twenty operations on numbers no larger than q[0].
    const double below = -1e-13;
    return q[0] < below && b1 < below && b2 < below && b3 < below && b4 < below;
}

/// All distinct roots of a polynomial in [low, high], ascending. A double root, where the polynomial touches zero
/// without changing its sign, is found if its computed value is exactly zero there.
inline std::vector<double> rootsIn(const Quartic& c, double low, double high) {
    std::array<Quartic, 4> chain{c};  // the polynomial and three derivatives, of which the last is linear
    for (std::size_t order = 1; order < chain.size(); ++order) chain[order] = derivative(chain[order - 1]);
    std::vector<double> roots;
    for (std::size_t order = chain.size(); order-- > 0;) {
        std::vector<double> knots{low};
        knots.insert(knots.end(), roots.begin(), roots.end());
        knots.push_back(high);
        roots = rootsBetweenKnots(chain[order], knots);
    }
    return roots;
}

}  // namespace oracle
