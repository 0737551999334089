#include "scenes/text/black_body.h"

#include <cmath>

namespace scenes {
namespace {

using engine::Vec3;

/// A bell that is wider on one of its sides, over wavelengths in nm.
struct Lobe {
    double height, center, widthBelow, widthAbove;

    double at(double wavelength) const {
        const double x = (wavelength - center) / (wavelength < center ? widthBelow : widthAbove);
        return height * std::exp(-0.5 * x * x);
    }
};

/// The color matching functions at a wavelength in nm.
Vec3 matchingFunctions(double wavelength) {
    constexpr Lobe kX[] = {{1.056, 599.8, 37.9, 31.0}, {0.362, 442.0, 16.0, 26.7}, {-0.065, 501.1, 20.4, 26.2}};
    constexpr Lobe kY[] = {{0.821, 568.8, 46.9, 40.5}, {0.286, 530.9, 16.3, 31.1}};
    constexpr Lobe kZ[] = {{1.217, 437.0, 11.8, 36.0}, {0.681, 459.0, 26.0, 13.8}};
    Vec3 sum(0.0, 0.0, 0.0);
    for (const Lobe& lobe : kX) sum.x() += lobe.at(wavelength);
    for (const Lobe& lobe : kY) sum.y() += lobe.at(wavelength);
    for (const Lobe& lobe : kZ) sum.z() += lobe.at(wavelength);
    return sum;
}

/// Radiance per wavelength of a black body by Planck's law, W/(sr m^3).
double planckRadiance(double wavelength, double temperature) {
    constexpr double kFirst = 1.191042972e-16;  // 2 h c^2, W m^2/sr (SI 2019)
    constexpr double kSecond = 1.438776877e-2;  // h c / k, m K
    return kFirst / (std::pow(wavelength, 5) * std::expm1(kSecond / (wavelength * temperature)));
}

/// Linear sRGB of tristimulus values, by the inverse of the matrix of IEC 61966-2-1.
Vec3 linearFromXyz(const Vec3& xyz) {
    return {xyz.dot(Vec3(3.2404542, -1.5371385, -0.4985314)), xyz.dot(Vec3(-0.9692660, 1.8760108, 0.0415560)),
            xyz.dot(Vec3(0.0556434, -0.2040259, 1.0572252))};
}

Vec3 blackBodyRgb(double temperature) {
    return linearFromXyz(blackBodyXyz(temperature)).cwiseMax(0.0);
}

}  // namespace

Vec3 blackBodyXyz(double temperature) {
    if (!(temperature > 0.0)) return {0.0, 0.0, 0.0};
    constexpr double kNanometer = 1e-9;
    constexpr double kStep = 2.0;                // nm; a tenth of the narrowest lobe
    constexpr double kLuminousEfficacy = 683.0;  // lm/W
    Vec3 sum(0.0, 0.0, 0.0);
    for (double wavelength = 360.0; wavelength <= 830.0; wavelength += kStep)
        sum += planckRadiance(wavelength * kNanometer, temperature) * matchingFunctions(wavelength);
    return kLuminousEfficacy * kStep * kNanometer * sum;
}

std::vector<Vec3> blackBodyRamp(double low, double high, int count) {
    const double brightest = blackBodyRgb(high).maxCoeff();
    std::vector<Vec3> colors;
    for (int k = 0; k < count; ++k) {
        const double temperature = low + (high - low) * k / (count - 1);
        colors.push_back((blackBodyRgb(temperature) / brightest).cwiseSqrt());
    }
    return colors;
}

}  // namespace scenes
