// Balls sorted into the cells of a uniform grid, so that a ray of the oracle tries only balls that it may meet. No ball
// is left out: a ball that a ray crosses lies in a cell that the ray crosses. Used by the oracle and by the study of
// pictures; it shares nothing with the renderer's grids, which the oracle judges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "studies/oracle/intersections.h"

namespace oracle {

/// What a grid needs to know of a ball.
struct Extent {
    dvec3 center{0.0};
    double radius = 0.0;
};

/// Indices of balls, in rising order.
using Indices = std::vector<std::uint32_t>;

class BallGrid {
 public:
    explicit BallGrid(const std::vector<Extent>& balls);

    /// All balls that the ray may cross, and perhaps others.
    Indices along(const Ray& ray) const;
    /// All balls that may reach into a cube around a point, and perhaps others.
    Indices within(const dvec3& point, double halfSide) const;

 private:
    using Cell = std::array<int, 3>;

    std::size_t cellIndex(const Cell& cell) const;
    /// The cell of a coordinate along an axis, or the nearest cell of the grid.
    int cellAlong(std::size_t axis, double coordinate) const;
    /// Calls visit(cell index) for every cell that a cube around a point touches.
    template <typename Visit>
    void forCells(const dvec3& point, double halfSide, const Visit& visit) const;

    dvec3 low_{0.0};
    double cellSize_ = 1.0;                   ///< m
    std::array<int, 3> cellCounts_{0, 0, 0};  ///< along each axis
    std::vector<std::uint32_t> begin_;  ///< where the list of each cell begins in lists_, and where the last one ends
    Indices lists_;
};

}  // namespace oracle
