// Logarithms and powers of two in single precision with the same bits on every machine, which the functions of the C
// library do not promise. Used for Beer's law.
#pragma once

#include <cmath>

namespace render {

/// The binary logarithm of a normal number above 0, within 1e-6.
inline float log2Of(float value) {
    // With value = m 2^e and s = (m - c)/(m + c), |s| <= 0.172, log2(m/c) is 2 atanh(s)/log(2); the first term of
    // atanh's series that is left out is below 2e-8.
    constexpr float kMiddle = 0.70710678F;
    int exponent = 0;
    const float mantissa = std::frexp(value, &exponent);
    const float s = (mantissa - kMiddle) / (mantissa + kMiddle);
    const float square = s * s;
    const float series = s * (1.0F + square * (1.0F / 3.0F + square * (1.0F / 5.0F + square * (1.0F / 7.0F))));
    return static_cast<float>(exponent) - 0.5F + 2.8853901F * series;
}

/// 2 to the power of a number of at most 0, within 1e-6 of 1; 0 below 2^-100.
inline float exp2Of(float power) {
    if (power < -100.0F) return 0.0F;
    // With y = (fraction - 1/2) log(2), |y| <= 0.347, the Taylor polynomial of degree 6 of exp(y) is within 2e-7.
    const float whole = std::floor(power);
    const float y = (power - whole - 0.5F) * 0.69314718F;
    const float series =
        1.0F +
        y * (1.0F + y * (0.5F + y * (1.0F / 6.0F + y * (1.0F / 24.0F + y * (1.0F / 120.0F + y * (1.0F / 720.0F))))));
    return std::ldexp(1.41421356F * series, static_cast<int>(whole));
}

}  // namespace render
