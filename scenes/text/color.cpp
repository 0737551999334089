// The sRGB curve, hexadecimal colors, color ramps and color maps.
//
// A color map is given by the lightness of its ends and by a Bezier curve in the plane of OKLab's a and b. Distances in
// OKLab approximate perceived differences, so equal arc lengths along the curve, combined with equal steps of
// lightness, give colors that look equally far apart. Drawing a map as a curve at even lightness is the idea of van der
// Walt and Smith (viscm, 2015); the curves are our own. Their control points were chosen for looks, then moved until
// the steps were also nearly equal by CIEDE2000 and every color was inside the sRGB gamut.
// OKLab: B. Ottosson, A perceptual color space for image processing (2020), whose matrices are used below.
#include "scenes/text/color.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace scenes {
namespace {

using engine::Vec3;

/// A point of OKLab's chromatic plane: a, from green to red, and b, from blue to yellow.
using Chroma = glm::dvec2;

struct MapCurve {
    std::string_view name;
    double startLightness = 0.0;  ///< OKLab lightness of the first color
    double endLightness = 1.0;    ///< OKLab lightness of the last color
    std::vector<Chroma> controlPoints;
};

const std::vector<MapCurve> kCurves = {
    // Color map from violet through blue, teal and green to yellow.
    {"lagoon", 0.30, 0.92, {{0.034, -0.092}, {-0.046, -0.119}, {-0.092, -0.028}, {-0.168, 0.085}, {-0.046, 0.185}}},
    // Color map from nearly black through purple, red and orange to pale yellow.
    {"ember", 0.22, 0.93, {{0.015, -0.063}, {0.138, -0.070}, {0.244, 0.089}, {0.116, 0.186}, {-0.025, 0.118}}},
    // Color map from blue through gray to yellow. It avoids red against green, for color-blind viewers.
    {"dusk", 0.28, 0.91, {{-0.006, -0.090}, {-0.014, -0.064}, {-0.020, 0.0}, {-0.008, 0.059}, {-0.015, 0.124}}},
    // Color map from deep blue to the white of ice.
    {"glacier", 0.30, 0.96, {{0.008, -0.111}, {-0.039, -0.156}, {-0.062, -0.071}, {-0.009, -0.005}}},
};

Vec3 linearFromOklab(double lightness, const Chroma& chroma) {
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * chroma.x + 0.2158037573 * chroma.y);
    const double m = cube(lightness - 0.1055613458 * chroma.x - 0.0638541728 * chroma.y);
    const double s = cube(lightness - 0.0894841775 * chroma.x - 1.2914855480 * chroma.y);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

Chroma lerp(const Chroma& from, const Chroma& to, double t) {
    return from + (to - from) * t;
}

/// The point at parameter t of a Bezier curve, by de Casteljau's algorithm.
Chroma bezierPoint(std::vector<Chroma> points, double t) {
    for (std::size_t left = points.size() - 1; left > 0; --left)
        for (std::size_t k = 0; k < left; ++k) points[k] = lerp(points[k], points[k + 1], t);
    return points[0];
}

/// A curve in the chromatic plane as short straight segments, with the arc length from its start to each point.
struct Polyline {
    std::vector<Chroma> points;
    std::vector<double> arcLengths;
};

Polyline polylineOf(const MapCurve& curve) {
    constexpr int kSegmentCount = 2000;  // a segment is about 1e-4 of OKLab long, far below what can be seen
    Polyline line{{curve.controlPoints.front()}, {0.0}};
    for (int k = 1; k <= kSegmentCount; ++k) {
        const Chroma next = bezierPoint(curve.controlPoints, static_cast<double>(k) / kSegmentCount);
        line.arcLengths.push_back(line.arcLengths.back() + distance(line.points.back(), next));
        line.points.push_back(next);
    }
    return line;
}

const MapCurve& findCurve(std::string_view name) {
    for (const MapCurve& curve : kCurves)
        if (curve.name == name) return curve;
    throw std::logic_error("scenes: there is no color map " + std::string(name));
}

}  // namespace

double linearFromSrgb(double component) {
    return component <= 0.04045 ? component / 12.92 : std::pow((component + 0.055) / 1.055, 2.4);
}

std::array<std::uint8_t, 3> srgbBytes(const Vec3& linear) {
    std::array<std::uint8_t, 3> bytes{};
    for (std::size_t index = 0; index < 3; ++index) {
        const double light = std::clamp(linear[static_cast<int>(index)], 0.0, 1.0);
        const double component = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
        bytes[index] = static_cast<std::uint8_t>(std::lround(255.0 * component));
    }
    return bytes;
}

std::optional<Vec3> colorFromHex(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    unsigned code = 0;
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data() + 1, end, code, 16).ptr != end) return std::nullopt;
    const auto channel = [&](unsigned shift) { return linearFromSrgb((code >> shift & 0xFFU) / 255.0); };
    return Vec3(channel(16), channel(8), channel(0));
}

Vec3 rampColor(const std::vector<Vec3>& colors, double parameter) {
    // The negated comparison is true for a parameter that is NaN, which therefore gives the first color.
    if (!(parameter > 0.0) || colors.size() == 1) return colors.front();
    if (parameter >= 1.0) return colors.back();
    const double scaled = parameter * static_cast<double>(colors.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(scaled), colors.size() - 2);
    const double t = scaled - static_cast<double>(below);
    return (1.0 - t) * colors[below] + t * colors[below + 1];
}

std::vector<std::string_view> colorMapNames() {
    std::vector<std::string_view> names;
    for (const MapCurve& curve : kCurves) names.push_back(curve.name);
    return names;
}

std::vector<Vec3> colorMap(std::string_view name, int count) {
    const MapCurve& curve = findCurve(name);
    const Polyline line = polylineOf(curve);
    std::vector<Vec3> colors;
    std::size_t segment = 0;
    for (int k = 0; k < count; ++k) {
        const double share = static_cast<double>(k) / (count - 1);
        const double length = share * line.arcLengths.back();
        while (segment + 2 < line.arcLengths.size() && line.arcLengths[segment + 1] < length) ++segment;
        const double t =
            (length - line.arcLengths[segment]) / (line.arcLengths[segment + 1] - line.arcLengths[segment]);
        const Chroma chroma = lerp(line.points[segment], line.points[segment + 1], t);
        colors.push_back(
            linearFromOklab(curve.startLightness + (curve.endLightness - curve.startLightness) * share, chroma));
    }
    return colors;
}

}  // namespace scenes
