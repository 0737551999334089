// Sine and cosine, for the poses of what turns. Written out because the last bit of the library's functions may differ
// from machine to machine.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace engine {

struct SineAndCosine {
    double sine = 0.0;
    double cosine = 1.0;
};

/// 1/(n (n + 1)) for n = 0 (unused), 1, 2, ...: the ratios of neighboring Taylor coefficients.
inline constexpr auto kTaylorRatios = [] {
    std::array<double, 18> ratios{};
    for (std::size_t n = 1; n < ratios.size(); ++n) ratios[n] = 1.0 / static_cast<double>(n * (n + 1));
    return ratios;
}();

/// Sine and cosine of the sum of a number of quarter turns and of a rest x (rad), at most an eighth of a turn.
inline SineAndCosine ofQuartersAndRest(double quarters, double x) {
    const double square = x * x;
    // Taylor to x^17/17! and x^18/18!: the first terms left out are below (pi/4)^19/19! = 9e-20.
    double sine = 1.0;
    for (std::size_t n = 16; n >= 2; n -= 2) sine = 1.0 - sine * (square * kTaylorRatios[n]);
    sine *= x;
    double cosine = 1.0;
    for (std::size_t n = 17; n >= 3; n -= 2) cosine = 1.0 - cosine * (square * kTaylorRatios[n]);
    cosine = 1.0 - cosine * (0.5 * square);
    switch (static_cast<long long>(quarters) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

/// Sine and cosine of an angle (rad) of at most a million, the same bits on every machine, within 4e-16. The angle is
/// reduced to at most an eighth of a turn by subtracting quarter turns in three parts, which leave an error far below
/// that.
inline SineAndCosine sineAndCosine(double angle) {
    constexpr double kQuarterHigh = 1.5707963267341256;       // the leading 33 bits of pi/2
    constexpr double kQuarterMiddle = 6.077100506303966e-11;  // the next 33 bits
    constexpr double kQuarterLow = 2.0222662487959506e-21;
    constexpr double kQuartersInUnit = 0.6366197723675814;  // 2/pi
    const double quarters = std::floor(angle * kQuartersInUnit + 0.5);
    return ofQuartersAndRest(quarters,
                             ((angle - quarters * kQuarterHigh) - quarters * kQuarterMiddle) - quarters * kQuarterLow);
}

/// Sine and cosine of an angle in degrees, likewise; exact for multiples of 90 degrees.
inline SineAndCosine sineAndCosineOfDegrees(double degrees) {
    const double within = std::fmod(degrees, 360.0);  // exact
    const double quarters = std::floor(within / 90.0 + 0.5);
    return ofQuartersAndRest(quarters, (within - 90.0 * quarters) * (std::numbers::pi / 180.0));
}

}  // namespace engine
