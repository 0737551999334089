// Particles by place, so that the oracle's rays try only those that they may touch. It leaves out none: a ball that a
// ray crosses lies in a cell that the ray crosses. Used by the oracle alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/view.h"

namespace oracle {

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit length
};

/// Indices of particles, in rising order.
using Indices = std::vector<std::uint32_t>;

class Crowd {
 public:
    /// Every particle is near every ray.
    static Crowd everyone(const render::View& view);

    /// Sorted into cells of a grid by their reach (metaballs) or radius (spheres).
    explicit Crowd(const render::View& view);

    /// All particles of which the ray may cross the ball, and perhaps others.
    Indices along(const Ray& ray) const;

 private:
    Crowd() = default;
    std::size_t cellAt(const std::array<int, 3>& cell) const;

    bool all_ = false;
    std::uint32_t count_ = 0;
    glm::dvec3 low_{0.0};
    double cellSize_ = 1.0;
    std::array<int, 3> cells_{0, 0, 0};
    std::vector<std::uint32_t> begin_;  ///< per cell and one more: where its list begins
    Indices lists_;
};

}  // namespace oracle
