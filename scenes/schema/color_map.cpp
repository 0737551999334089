// A map is given by the lightness of its ends and by a Bezier curve in the plane of OKLab's a and b. Distances in OKLab
// are differences to the eye (nearly), so along the curve, taken by its length, both the steps and their share of
// lightness are the same everywhere. The idea of drawing a map as a curve at even lightness is van der Walt and Smith's
// (viscm, 2015); the curves are ours. Their control points were chosen for looks, then moved until the steps were also
// nearly equal by CIEDE2000 and every color could be shown.
// OKLab: B. Ottosson, A perceptual color space for image processing (2020), whose matrices are used below.
#include "scenes/schema/color_map.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace scenes {
namespace {

using engine::Vec3;

/// A point of OKLab's chromatic plane: green to red, blue to yellow.
struct Chroma {
    double a = 0.0;
    double b = 0.0;
};

struct MapCurve {
    std::string_view name;
    double darkest = 0.0;   ///< OKLab lightness of the first color
    double lightest = 1.0;  ///< of the last
    std::vector<Chroma> controls;
};

const std::vector<MapCurve>& curves() {
    static const std::vector<MapCurve> kCurves = {
        // Violet, blue, teal, green, yellow.
        {"lagoon", 0.30, 0.92, {{0.034, -0.092}, {-0.046, -0.119}, {-0.092, -0.028}, {-0.168, 0.085}, {-0.046, 0.185}}},
        // Night, purple, red, orange, pale yellow.
        {"ember", 0.22, 0.93, {{0.015, -0.063}, {0.138, -0.070}, {0.244, 0.089}, {0.116, 0.186}, {-0.025, 0.118}}},
        // Blue, gray, yellow: no red against green.
        {"dusk", 0.28, 0.91, {{-0.006, -0.090}, {-0.014, -0.064}, {-0.020, 0.0}, {-0.008, 0.059}, {-0.015, 0.124}}},
        // Deep blue to the white of ice.
        {"glacier", 0.30, 0.96, {{0.008, -0.111}, {-0.039, -0.156}, {-0.062, -0.071}, {-0.009, -0.005}}},
    };
    return kCurves;
}

Vec3 linearFromOklab(double lightness, const Chroma& chroma) {
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * chroma.a + 0.2158037573 * chroma.b);
    const double m = cube(lightness - 0.1055613458 * chroma.a - 0.0638541728 * chroma.b);
    const double s = cube(lightness - 0.0894841775 * chroma.a - 1.2914855480 * chroma.b);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Chroma between(const Chroma& from, const Chroma& to, double share) {
    return {from.a + (to.a - from.a) * share, from.b + (to.b - from.b) * share};
}

/// De Casteljau's construction.
Chroma bezier(std::vector<Chroma> points, double t) {
    for (std::size_t left = points.size() - 1; left > 0; --left)
        for (std::size_t k = 0; k < left; ++k) points[k] = between(points[k], points[k + 1], t);
    return points[0];
}

/// A curve as short straight pieces, with the length up to each of their ends.
struct Polyline {
    std::vector<Chroma> points;
    std::vector<double> lengths;
};

Polyline polylineOf(const MapCurve& curve) {
    constexpr int kPieces = 2000;  // a piece is some 1e-4 of OKLab long, far below what can be seen
    Polyline line{{curve.controls.front()}, {0.0}};
    for (int k = 1; k <= kPieces; ++k) {
        const Chroma next = bezier(curve.controls, static_cast<double>(k) / kPieces);
        const double da = next.a - line.points.back().a;
        const double db = next.b - line.points.back().b;
        line.points.push_back(next);
        line.lengths.push_back(line.lengths.back() + std::sqrt(da * da + db * db));
    }
    return line;
}

const MapCurve& curveNamed(std::string_view name) {
    for (const MapCurve& curve : curves())
        if (curve.name == name) return curve;
    throw std::logic_error("scenes: there is no color map " + std::string(name));
}

}  // namespace

const std::vector<std::string_view>& colorMapNames() {
    static const std::vector<std::string_view> kNames = [] {
        std::vector<std::string_view> names;
        for (const MapCurve& curve : curves()) names.push_back(curve.name);
        return names;
    }();
    return kNames;
}

std::vector<Vec3> colorMap(std::string_view name, int count) {
    const MapCurve& curve = curveNamed(name);
    const Polyline line = polylineOf(curve);
    std::vector<Vec3> colors;
    std::size_t piece = 0;
    for (int k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / (count - 1);
        const double length = share * line.lengths.back();
        while (piece + 2 < line.lengths.size() && line.lengths[piece + 1] < length) ++piece;
        const double within = (length - line.lengths[piece]) / (line.lengths[piece + 1] - line.lengths[piece]);
        const Chroma chroma = between(line.points[piece], line.points[piece + 1], within);
        colors.push_back(linearFromOklab(curve.darkest + (curve.lightest - curve.darkest) * share, chroma));
    }
    return colors;
}

}  // namespace scenes
