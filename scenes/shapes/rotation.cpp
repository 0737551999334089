#include "scenes/shapes/rotation.h"

#include <cmath>
#include <numbers>

namespace scenes {
namespace {

/// Sum of a Taylor series whose terms are each the one before times -square / (k (k + 1)), for k = first, first + 2 ...
/// The square is at most (pi / 4)^2: after ten terms the rest is below 1e-18.
double alternatingSeries(double term, double square, int first) {
    double terms[10];
    for (int k = 0; k < 10; ++k) {
        terms[k] = term;
        const double factor = first + 2 * k;
        term *= -square / (factor * (factor + 1.0));
    }
    double sum = 0.0;
    for (int k = 9; k >= 0; --k) sum += terms[k];  // from the smallest to the largest
    return sum;
}

engine::Matrix3 product(const engine::Matrix3& a, const engine::Matrix3& b) {
    engine::Matrix3 result;
    for (int column = 0; column < 3; ++column) result.col(column) = transformed(a, b.col(column));
    return result;
}

}  // namespace

CosSin cosSinOfDegrees(double degrees) {
    // std::fmod is exact.
    const double turned = std::fmod(degrees, 360.0);
    const double quarters = std::floor(turned / 90.0 + 0.5);
    const double radians = (turned - 90.0 * quarters) * (std::numbers::pi / 180.0);
    const double square = radians * radians;
    const CosSin rest{alternatingSeries(1.0, square, 1), alternatingSeries(radians, square, 2)};
    switch ((static_cast<int>(quarters) % 4 + 4) % 4) {
        case 1:
            return {-rest.sin, rest.cos};
        case 2:
            return {-rest.cos, -rest.sin};
        case 3:
            return {rest.sin, -rest.cos};
        default:
            return rest;
    }
}

engine::Matrix3 rotationOfDegrees(const engine::Vec3& degrees) {
    const CosSin x = cosSinOfDegrees(degrees.x());
    const CosSin y = cosSinOfDegrees(degrees.y());
    const CosSin z = cosSinOfDegrees(degrees.z());
    engine::Matrix3 aboutX;
    engine::Matrix3 aboutY;
    engine::Matrix3 aboutZ;
    aboutX << 1.0, 0.0, 0.0, 0.0, x.cos, -x.sin, 0.0, x.sin, x.cos;
    aboutY << y.cos, 0.0, y.sin, 0.0, 1.0, 0.0, -y.sin, 0.0, y.cos;
    aboutZ << z.cos, -z.sin, 0.0, z.sin, z.cos, 0.0, 0.0, 0.0, 1.0;
    return product(aboutZ, product(aboutY, aboutX));
}

engine::Vec3 transformed(const engine::Matrix3& matrix, const engine::Vec3& vector) {
    return {engine::dot(matrix.row(0), vector), engine::dot(matrix.row(1), vector), engine::dot(matrix.row(2), vector)};
}

}  // namespace scenes
