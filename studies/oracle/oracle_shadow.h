// The oracle's soft shadows: what spheres and boxes cover of the light, and where the rays to the light start under
// metaballs, by render/picture/view.h. Header only: the oracle is its only user.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace oracle {

struct ShadedPoint {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec3 toLight{0.0};  ///< unit length
    double softness = 0.0;
};

inline double softEdge(double x) {
    const double t = std::clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

inline double meanRadius(const render::View& view) {
    double sum = 0.0;
    for (const render::Sphere& particle : view.particles) sum += double(particle.radius);
    return view.particles.empty() ? 0.0 : sum / static_cast<double>(view.particles.size());
}

inline double coverOfSphere(const ShadedPoint& shaded, const glm::dvec3& center, double radius) {
    const glm::dvec3 off = center - shaded.point;
    const double along = glm::dot(off, shaded.toLight);
    const double aside = glm::length(off - along * shaded.toLight);
    const double top = along + std::sqrt(std::max(0.0, radius * radius - aside * aside));
    if (top <= 0.01 * radius) return 0.0;
    const double width = shaded.softness * std::min(radius, 0.5 * std::max(along, 0.0));
    if (width == 0.0) return aside < radius ? 1.0 : 0.0;
    return softEdge((radius - aside) / width);
}

/// Directions that span the light's plane; the same as the renderer's, because a filter has axes.
inline std::array<glm::dvec3, 2> lightAxes(const glm::dvec3& toLight) {
    const glm::dvec3 other = std::abs(toLight.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(other, toLight));
    return {u, glm::cross(toLight, u)};
}

/// Distance along the ray at which it leaves the box; negative where it misses it or the box lies behind.
inline double exitOf(const ShadedPoint& shaded, const render::BoxObstacle& box) {
    double enter = -std::numeric_limits<double>::infinity();
    double exit = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = shaded.toLight[axis];
        const double low = double(box.minimum[axis]) - shaded.point[axis];
        const double high = double(box.maximum[axis]) - shaded.point[axis];
        if (slope == 0.0) continue;
        enter = std::max(enter, std::min(low / slope, high / slope));
        exit = std::min(exit, std::max(low / slope, high / slope));
    }
    return exit;
}

/// The corners on the light's plane; of each line through two of them with all others on one side, the distance
/// inwards.
inline double coverOfBox(const ShadedPoint& shaded, const render::BoxObstacle& box, double particleRadius) {
    const double exit = exitOf(shaded, box);
    if (exit <= 1e-4 * glm::distance(glm::dvec3(box.minimum), glm::dvec3(box.maximum))) return 0.0;
    const std::array<glm::dvec3, 2> axes = lightAxes(shaded.toLight);
    std::array<glm::dvec2, 8> corners{};
    for (unsigned k = 0; k < 8; ++k) {
        const glm::dvec3 corner((k & 1U) != 0 ? box.maximum.x : box.minimum.x,
                                (k & 2U) != 0 ? box.maximum.y : box.minimum.y,
                                (k & 4U) != 0 ? box.maximum.z : box.minimum.z);
        corners[k] = {glm::dot(corner - shaded.point, axes[0]), glm::dot(corner - shaded.point, axes[1])};
    }
    double inside = std::numeric_limits<double>::infinity();
    for (const glm::dvec2& from : corners) {
        for (const glm::dvec2& to : corners) {
            const glm::dvec2 along = to - from;
            if (glm::length(along) < 1e-9) continue;
            const glm::dvec2 left = glm::dvec2(-along.y, along.x) / glm::length(along);
            const bool side = std::all_of(corners.begin(), corners.end(), [&](const glm::dvec2& other) {
                return glm::dot(other - from, left) > -1e-9;
            });
            if (side) inside = std::min(inside, glm::dot(-from, left));
        }
    }
    const double width = shaded.softness * std::min(particleRadius, 0.5 * exit);
    return softEdge(inside / std::max(width, 1e-12));
}

/// The place that a share of a quadratic B-spline, three wide and centered on 0, lies below; by bisection.
inline double splineQuantile(double share) {
    const auto below = [](double x) {
        if (x < -0.5) return (x + 1.5) * (x + 1.5) * (x + 1.5) / 6.0;
        if (x > 0.5) return 1.0 - (1.5 - x) * (1.5 - x) * (1.5 - x) / 6.0;
        return 0.5 + 0.75 * x - x * x * x / 3.0;
    };
    double low = -1.5;
    double high = 1.5;
    for (int k = 0; k < 40; ++k) (below(0.5 * (low + high)) < share ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
}

/// A number in [0, 1) that differs from point to point, so that what a few rays leave out averages away over a pixel.
inline double shiftFor(const glm::dvec3& point, std::uint64_t salt) {
    std::uint64_t z = salt;
    for (int axis = 0; axis < 3; ++axis) {
        z ^= std::bit_cast<std::uint64_t>(point[axis]);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
    }
    return static_cast<double>(z >> 11) * 0x1p-53;
}

/// Where rays to the light start that stand for the filter's, equally many for equal weights.
inline std::vector<glm::dvec3> fieldShadowStarts(const ShadedPoint& shaded, double particleRadius) {
    constexpr int kPerAxis = 3;
    const double step = 0.5 * shaded.softness * particleRadius;
    const std::array<glm::dvec3, 2> axes = lightAxes(shaded.toLight);
    const glm::dvec3 middle = shaded.point + 1.5 * step * shaded.normal + 0.5 * step * shaded.toLight;
    std::vector<glm::dvec3> starts;
    for (int j = 0; j < kPerAxis; ++j) {
        for (int i = 0; i < kPerAxis; ++i) {
            const double u = splineQuantile((i + shiftFor(middle, 1)) / kPerAxis);
            const double v = splineQuantile((j + shiftFor(middle, 2)) / kPerAxis);
            starts.push_back(middle + step * (u * axes[0] + v * axes[1]));
        }
    }
    return starts;
}

}  // namespace oracle
