// Balls by place, so that the oracle's rays try only those that they may touch. It leaves out none: a ball that a
// ray crosses lies in a cell that the ray crosses. Used by the oracle alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <cstddef>

#include <glm/glm.hpp>

namespace oracle {

struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit length
};

struct Extent {
    glm::dvec3 center{0.0};
    double radius = 0.0;
};

/// Indices of balls, in rising order.
using Indices = std::vector<std::uint32_t>;

class BallGrid {
 public:
    /// Every ball is near every ray.
    static BallGrid everyone(std::size_t count);

    /// Sorted into cells of a grid.
    explicit BallGrid(const std::vector<Extent>& balls);

    /// All balls that the ray may cross, and perhaps others.
    Indices along(const Ray& ray) const;
    /// All balls that may reach into a cube around a place, and perhaps others.
    Indices within(const glm::dvec3& place, double halfSide) const;

 private:
    BallGrid() = default;
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
