// The sums of the definition, as they stand there.
#include "studies/oracle/oracle_sky.h"

#include <cmath>
#include <numbers>

namespace oracle {
namespace {

using glm::dvec3;

bool lookedAt(const render::View& view) {
    return view.ambient.occlusion > 0.0F || view.surface.reflection > 0.0F || view.surface.translucency > 0.0F ||
           view.surface.absorption > 0.0F;
}

double sideFor(const render::View& view) {
    double mean = 0.0;
    for (const render::Sphere& particle : view.particles) mean += double(particle.radius);
    mean /= static_cast<double>(view.particles.size());
    return std::exp2(std::ceil(4.0 * std::log2(2.0 * mean) - 1e-9) / 4.0);
}

/// Calls visit(cube, weight) for the eight cubes whose middles surround a place.
template <typename Visit>
void forSurrounding(const dvec3& place, double side, const Visit& visit) {
    const dvec3 at = place / side - 0.5;
    const dvec3 low = glm::floor(at);
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const dvec3 weights = 1.0 - glm::abs(at - low - step);
        const dvec3 cube = low + step;
        visit({static_cast<std::int64_t>(cube.x), static_cast<std::int64_t>(cube.y), static_cast<std::int64_t>(cube.z)},
              weights.x * weights.y * weights.z);
    }
}

}  // namespace

double openToward(const SixValues& open, const dvec3& d) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        sum += d[axis] * d[axis] * open[static_cast<std::size_t>(2 * axis + (d[axis] > 0.0 ? 0 : 1))];
    return sum;
}

std::size_t Sky::Hash::operator()(const Cube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cube) hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 29));
}

Sky::Sky(const render::View& view) : particles_(view.particles.size(), kAllOpen) {
    if (view.particles.empty() || !lookedAt(view)) return;
    side_ = sideFor(view);
    Filling spread;
    for (const render::Sphere& particle : view.particles) {
        const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(double(particle.radius) / side_, 3.0);
        forSurrounding(dvec3(particle.center), side_,
                       [&](const Cube& cube, double weight) { spread[cube] += weight * volume; });
    }
    constexpr std::array<double, 3> kBlur = {0.25, 0.5, 0.25};
    for (const auto& [cube, value] : spread)
        for (std::size_t k = 0; k < 27; ++k) {
            const std::array<std::size_t, 3> step = {k % 3, k / 3 % 3, k / 9};
            Cube other = cube;
            for (std::size_t axis = 0; axis < 3; ++axis) other[axis] += static_cast<std::int64_t>(step[axis]) - 1;
            full_[other] += kBlur[step[0]] * kBlur[step[1]] * kBlur[step[2]] * value;
        }
    for (std::size_t k = 0; k < view.particles.size(); ++k) particles_[k] = at(dvec3(view.particles[k].center));
}

double Sky::along(int axis, int sign, const Cube& cube) const {
    double tau = 0.0;
    for (int j = 1; j <= 6; ++j) {
        Cube ahead = cube;
        ahead[static_cast<std::size_t>(axis)] += sign * j;
        const auto found = full_.find(ahead);
        if (found != full_.end()) tau += (1.0 - (j - 0.5) / 6.0) * found->second;
    }
    return 1.0 / ((1.0 + tau) * (1.0 + tau));
}

SixValues Sky::at(const dvec3& place) const {
    SixValues open = kAllOpen;
    if (full_.empty()) return open;
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const int sign = direction % 2 == 0 ? 1 : -1;
        dvec3 moved = place;
        moved[axis] += 0.75 * side_ * sign;
        double sum = 0.0;
        forSurrounding(moved, side_, [&](const Cube& cube, double weight) { sum += weight * along(axis, sign, cube); });
        open[static_cast<std::size_t>(direction)] = sum;
    }
    return open;
}

}  // namespace oracle
