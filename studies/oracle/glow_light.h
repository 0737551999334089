// The light of glowing particles by section 3 of render/picture/shading_model.h. Header only: it is used by the oracle
// alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "studies/oracle/sky_visibility.h"

namespace oracle {

class GlowLight {
 public:
    GlowLight(const render::View& view, const SkyVisibility& sky) {
        if (view.particles.empty() || !(view.surface.glow > 0.0F)) return;
        for (side_ = 2.0 * sky.side();; side_ *= 2.0) {
            spread(view, sky);
            if (emission_.size() <= 1024 && cellCount() <= 131072.0) return;
        }
    }

    /// glowLight(n) at a point.
    glm::dvec3 at(const glm::dvec3& point, const glm::dvec3& n) const {
        glm::dvec3 sum{0.0};
        if (emission_.empty()) return sum;
        forSurrounding(point, [&](const Cube& cube, double weight) {
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 side{0.0};
                side[axis] = n[axis] > 0.0 ? 1.0 : -1.0;
                sum += weight * n[axis] * n[axis] * irradiance(cube, side);
            }
        });
        return sum;
    }

 private:
    using Cube = std::array<int, 3>;
    using Intensities = std::array<glm::dvec3, 6>;

    template <typename Visit>
    void forSurrounding(const glm::dvec3& point, const Visit& visit) const {
        const glm::dvec3 at = point / side_ - 0.5;
        const glm::dvec3 low = glm::floor(at);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 cube = low + glm::dvec3(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::dvec3 weights = 1.0 - glm::abs(at - cube);
            visit(Cube{int(cube.x), int(cube.y), int(cube.z)}, weights.x * weights.y * weights.z);
        }
    }

    void spread(const render::View& view, const SkyVisibility& sky) {
        emission_.clear();
        for (std::uint32_t k = 0; k < view.particles.size(); ++k) {
            const render::Sphere& particle = view.particles[k];
            if (!(particle.radius > 0.0F)) continue;
            const glm::dvec3 albedo(particle.color);
            const double scale = double(view.surface.glow) * double(particle.radius) * double(particle.radius);
            forSurrounding(glm::dvec3(particle.center), [&](const Cube& cube, double weight) {
                if (weight == 0.0) return;
                for (std::size_t s = 0; s < 6; ++s)
                    emission_[cube][s] += weight * scale * sky.ofParticle(k)[s] * albedo * albedo;
            });
        }
    }

    /// Number of cubes of the box around all that the particles are spread over, six wider on each side.
    double cellCount() const {
        double count = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [least, most] =
                std::minmax_element(emission_.begin(), emission_.end(),
                                    [axis](const auto& a, const auto& b) { return a.first[axis] < b.first[axis]; });
            count *= most->first[axis] - least->first[axis] + 13.0;
        }
        return count;
    }

    /// Irradiance at the center of a cube on a surface that faces along an axis.
    glm::dvec3 irradiance(const Cube& cube, const glm::dvec3& facing) const {
        glm::dvec3 sum{0.0};
        for (const auto& [from, intensity] : emission_) {
            const glm::dvec3 offset = side_ * glm::dvec3(cube[0] - from[0], cube[1] - from[1], cube[2] - from[2]);
            const double distance = glm::length(offset);
            const double reach = 6.0 * side_;
            if (distance == 0.0 || distance >= reach) continue;
            const glm::dvec3 u = offset / distance;
            glm::dvec3 toward{0.0};
            for (int axis = 0; axis < 3; ++axis)
                toward += u[axis] * u[axis] * intensity[static_cast<std::size_t>(2 * axis + (u[axis] > 0.0 ? 0 : 1))];
            const double window = 1.0 - distance * distance / (reach * reach);
            sum += std::max(0.0, -glm::dot(u, facing)) * window * window /
                   (distance * distance + 0.25 * side_ * side_) * toward;
        }
        return sum;
    }

    double side_ = 1.0;  ///< side of a cube, m
    std::map<Cube, Intensities> emission_;
};

}  // namespace oracle
