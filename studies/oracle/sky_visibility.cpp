// Computes sky visibility by the formulas of section 3 of render/picture/shading_model.h. See sky_visibility.h.
#include "studies/oracle/sky_visibility.h"

#include <cmath>
#include <numbers>

#include "studies/oracle/oracle.h"

namespace oracle {
namespace {

/// Whether the shading of a view depends on the visibility of the sky.
bool isUsed(const render::View& view) {
    return view.ambient.occlusion > 0.0F || view.surface.reflection > 0.0F || view.surface.translucency > 0.0F ||
           view.surface.absorption > 0.0F || view.surface.glow > 0.0F;
}

/// Side of the cubes of the visibility grid, m: the smallest power of 2^(1/4) that is not below twice the particles'
/// mean radius. The 1e-9 allows for the rounding of the logarithm.
double cubeSide(const render::View& view) {
    return std::exp2(std::ceil(4.0 * std::log2(2.0 * meanRadius(view)) - 1e-9) / 4.0);
}

/// Calls visit(cube, trilinear weight) for the eight cubes of the visibility grid whose centers surround a point.
template <typename Visit>
void forSurrounding(const dvec3& point, double side, const Visit& visit) {
    const dvec3 at = point / side - 0.5;
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

double visibilityToward(const AxisVisibility& values, const dvec3& d) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        sum += d[axis] * d[axis] * values[static_cast<std::size_t>(2 * axis + (d[axis] > 0.0 ? 0 : 1))];
    return sum;
}

std::size_t SkyVisibility::Hash::operator()(const Cube& cube) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cube) hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(hash ^ (hash >> 29));
}

SkyVisibility::SkyVisibility(const render::View& view) : particles_(view.particles.size(), kAllVisible) {
    if (view.particles.empty() || !isUsed(view)) return;
    side_ = cubeSide(view);
    Density volumes;
    for (const render::Sphere& particle : view.particles) {
        const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(double(particle.radius) / side_, 3.0);
        forSurrounding(dvec3(particle.center), side_,
                       [&](const Cube& cube, double weight) { volumes[cube] += weight * volume; });
    }
    constexpr std::array<double, 3> kBlur = {0.25, 0.5, 0.25};
    for (const auto& [cube, volume] : volumes)
        for (std::size_t k = 0; k < 27; ++k) {
            const std::array<std::size_t, 3> step = {k % 3, k / 3 % 3, k / 9};
            Cube other = cube;
            for (std::size_t axis = 0; axis < 3; ++axis) other[axis] += static_cast<std::int64_t>(step[axis]) - 1;
            density_[other] += kBlur[step[0]] * kBlur[step[1]] * kBlur[step[2]] * volume;
        }
    for (std::size_t k = 0; k < view.particles.size(); ++k) particles_[k] = at(dvec3(view.particles[k].center));
}

double SkyVisibility::ofCube(int axis, int sign, const Cube& cube) const {
    double tau = 0.0;
    for (int j = 1; j <= 6; ++j) {
        Cube ahead = cube;
        ahead[static_cast<std::size_t>(axis)] += sign * j;
        const auto found = density_.find(ahead);
        if (found != density_.end()) tau += (1.0 - (j - 0.5) / 6.0) * found->second;
    }
    return 1.0 / ((1.0 + tau) * (1.0 + tau));
}

AxisVisibility SkyVisibility::at(const dvec3& point) const {
    AxisVisibility values = kAllVisible;
    if (density_.empty()) return values;
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const int sign = direction % 2 == 0 ? 1 : -1;
        dvec3 ahead = point;
        ahead[axis] += 0.75 * side_ * sign;
        double sum = 0.0;
        forSurrounding(ahead, side_,
                       [&](const Cube& cube, double weight) { sum += weight * ofCube(axis, sign, cube); });
        values[static_cast<std::size_t>(direction)] = sum;
    }
    return values;
}

}  // namespace oracle
