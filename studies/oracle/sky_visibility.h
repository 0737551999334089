// Sky visibility by section 3 of render/picture/shading_model.h, term by term in double precision. Cubes are kept in a
// hash table that holds only those that are not empty. Used by the oracle alone. For particles so scattered that
// shading_model.h widens the cubes the oracle is not valid.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace oracle {

/// The sky visibility of a point in the directions +x, -x, +y, -y, +z, -z, from 0 (hidden) to 1 (open).
using AxisVisibility = std::array<double, 6>;

inline constexpr AxisVisibility kAllVisible = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/// Sky visibility in a direction d of unit length: the sum over the axes of d_a^2 times the value on d's side.
double visibilityToward(const AxisVisibility& values, const glm::dvec3& d);

/// The sky visibility of every point of a view.
class SkyVisibility {
 public:
    /// Computes the sky visibility of every particle, if the shading of the view depends on it.
    explicit SkyVisibility(const render::View& view);

    AxisVisibility at(const glm::dvec3& point) const;
    double side() const { return side_; }
    const AxisVisibility& ofParticle(std::uint32_t particle) const { return particles_[particle]; }

 private:
    using Cube = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cube& cube) const;
    };
    using Density = std::unordered_map<Cube, double, Hash>;

    double ofCube(int axis, int sign, const Cube& cube) const;

    double side_ = 1.0;  ///< side of a cube of the grid, m
    Density density_;    ///< blurred density of the particles in each cube: F of shading_model.h
    std::vector<AxisVisibility> particles_;
};

}  // namespace oracle
