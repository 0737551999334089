// Openness as render/picture/view.h defines it, term by term in double precision, cubes kept in a table that has only
// those that are not empty; particles so scattered that view.h widens the cubes are not for it. Used by the oracle
// alone.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace oracle {

/// Along +x, -x, +y, -y, +z, -z.
using SixValues = std::array<double, 6>;

inline constexpr SixValues kAllOpen = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/// Sum over the axes of d_a^2 times the value on d's side of it. Shape: d of unit length.
double openToward(const SixValues& open, const glm::dvec3& d);

class Sky {
 public:
    /// Finds the openness of every particle, if a term of the view's shading looks at it.
    explicit Sky(const render::View& view);

    SixValues at(const glm::dvec3& place) const;
    const SixValues& ofParticle(std::uint32_t particle) const { return particles_[particle]; }

 private:
    using Cube = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cube& cube) const;
    };
    using Filling = std::unordered_map<Cube, double, Hash>;

    double along(int axis, int sign, const Cube& cube) const;

    double side_ = 1.0;
    Filling full_;
    std::vector<SixValues> particles_;
};

}  // namespace oracle
