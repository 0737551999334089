// Soft shadows by section 4 of render/picture/shading_model.h: the share of the light that spheres and boxes cover, and
// the origins of the rays to the light for metaballs. Header only: it is used by the oracle alone.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "studies/oracle/intersections.h"

namespace oracle {

/// A point on a surface, and the direction and softness of the light that may reach it.
struct ShadedPoint {
    dvec3 point{0.0};
    dvec3 normal{0.0};
    dvec3 toLight{0.0};     ///< direction to the light, unit length
    double softness = 0.0;  ///< softness of the light, S of shading_model.h
};

/// The soft edge of a shadow, rising from 0 to 1 between x = -1/2 and 1/2: edge(x) of shading_model.h.
inline double softEdge(double x) {
    const double t = std::clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// The share of the light that a sphere covers at a point.
inline double coverOfSphere(const ShadedPoint& shaded, const dvec3& center, double radius) {
    const dvec3 off = center - shaded.point;
    const double along = glm::dot(off, shaded.toLight);
    const double aside = glm::length(off - along * shaded.toLight);
    const double top = along + std::sqrt(std::max(0.0, radius * radius - aside * aside));
    if (top <= 0.01 * radius) return 0.0;
    const double width = shaded.softness * std::min(radius, 0.5 * std::max(along, 0.0));
    if (width == 0.0) return aside < radius ? 1.0 : 0.0;
    return softEdge((radius - aside) / width);
}

/// Two directions that span the plane across the direction to the light. They are the same as in the renderer, because
/// the shape of the filter of metaball shadows depends on its axes.
inline std::array<dvec3, 2> lightAxes(const dvec3& toLight) {
    const dvec3 other = std::abs(toLight.x) < 0.9 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    const dvec3 u = glm::normalize(glm::cross(other, toLight));
    return {u, glm::cross(toLight, u)};
}

/// The share of the light that a box covers at a point. Projects the corners of the box onto the plane across the light
/// and takes every line through two of them that has all other corners on its left. These lines bound the outline, so
/// that the least signed distance from them is the distance x in section 4 of shading_model.h.
inline double coverOfBox(const ShadedPoint& shaded, const render::BoxObstacle& box, double particleRadius) {
    const dvec3 minimum(box.minimum);
    const dvec3 maximum(box.maximum);
    const double exit = boxInterval({shaded.point, shaded.toLight}, minimum, maximum).exit;
    if (exit <= 1e-4 * glm::distance(minimum, maximum)) return 0.0;
    const std::array<dvec3, 2> axes = lightAxes(shaded.toLight);
    std::array<glm::dvec2, 8> corners{};
    for (unsigned k = 0; k < 8; ++k) {
        const dvec3 corner((k & 1U) != 0 ? maximum.x : minimum.x, (k & 2U) != 0 ? maximum.y : minimum.y,
                           (k & 4U) != 0 ? maximum.z : minimum.z);
        corners[k] = {glm::dot(corner - shaded.point, axes[0]), glm::dot(corner - shaded.point, axes[1])};
    }
    double inside = kInfinity;
    for (const glm::dvec2& from : corners) {
        for (const glm::dvec2& to : corners) {
            const glm::dvec2 along = to - from;
            if (glm::length(along) < 1e-9) continue;
            const glm::dvec2 left = glm::dvec2(-along.y, along.x) / glm::length(along);
            const bool isOutline = std::all_of(corners.begin(), corners.end(), [&](const glm::dvec2& other) {
                return glm::dot(other - from, left) > -1e-9;
            });
            if (isOutline) inside = std::min(inside, glm::dot(-from, left));
        }
    }
    const double width = shaded.softness * std::min(particleRadius, 0.5 * exit);
    return softEdge(inside / std::max(width, 1e-12));
}

/// The quantile of a quadratic B-spline of width 3 centered on 0, by bisection of its cumulative distribution: the x
/// below which the given share of its area lies.
inline double splineQuantile(double share) {
    const auto areaBelow = [](double x) {
        if (x < -0.5) return (x + 1.5) * (x + 1.5) * (x + 1.5) / 6.0;
        if (x > 0.5) return 1.0 - (1.5 - x) * (1.5 - x) * (1.5 - x) / 6.0;
        return 0.5 + 0.75 * x - x * x * x / 3.0;
    };
    double low = -1.5;
    double high = 1.5;
    for (int k = 0; k < 40; ++k) (areaBelow(0.5 * (low + high)) < share ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
}

/// A pseudorandom number in [0, 1) by a hash of a point. It shifts the few shadow rays that start at the point, so that
/// their sampling error averages out over a pixel.
inline double shiftFor(const dvec3& point, std::uint64_t salt) {
    std::uint64_t z = salt;
    for (int axis = 0; axis < 3; ++axis) {
        z ^= std::bit_cast<std::uint64_t>(point[axis]);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
    }
    return static_cast<double>(z >> 11) * 0x1p-53;
}

/// Origins of shadow rays to the light that sample a B-spline around a point with equal weights.
/// @param step  a third of the width of the spline, m
inline std::vector<dvec3> shadowOrigins(const dvec3& middle, double step, const dvec3& toLight) {
    constexpr int kPerAxis = 3;
    const std::array<dvec3, 2> axes = lightAxes(toLight);
    std::vector<dvec3> origins;
    for (int j = 0; j < kPerAxis; ++j) {
        for (int i = 0; i < kPerAxis; ++i) {
            const double u = splineQuantile((i + shiftFor(middle, 1)) / kPerAxis);
            const double v = splineQuantile((j + shiftFor(middle, 2)) / kPerAxis);
            origins.push_back(middle + step * (u * axes[0] + v * axes[1]));
        }
    }
    return origins;
}

/// Origins of the shadow rays for metaballs.
inline std::vector<dvec3> fieldShadowOrigins(const ShadedPoint& shaded, double particleRadius) {
    const double step = 0.5 * shaded.softness * particleRadius;
    const dvec3 middle = shaded.point + 1.5 * step * shaded.normal + 0.5 * step * shaded.toLight;
    return shadowOrigins(middle, step, shaded.toLight);
}

/// Origins of the shadow rays for meshes.
inline std::vector<dvec3> meshShadowOrigins(const ShadedPoint& shaded, double particleRadius) {
    const double step = 0.5 * shaded.softness * particleRadius;
    const double sine = glm::length(glm::cross(shaded.normal, shaded.toLight));
    return shadowOrigins(shaded.point + 1.5 * step * sine * shaded.normal, step, shaded.toLight);
}

}  // namespace oracle
