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

/// Center and radius of a ball that is sorted into a grid, m.
struct Extent {
    dvec3 center{0.0};
    double radius = 0.0;
};

/// Indices of some balls, in rising order.
using Indices = std::vector<std::uint32_t>;

/// A uniform grid of cells, each with a list of the balls that reach into it.
class BallGrid {
 public:
    explicit BallGrid(const std::vector<Extent>& balls);

    /// The indices of all balls that a ray may cross, and perhaps of some that it misses.
    Indices along(const Ray& ray) const;
    /// The indices of all balls that may reach into a cube around a point, and perhaps of some that do not.
    Indices within(const dvec3& point, double halfSide) const;

 private:
    using Cell = std::array<int, 3>;

    std::size_t cellIndex(const Cell& cell) const;
    /// The number of the cell along an axis that contains a coordinate (m), or that is nearest to it.
    int cellAlong(std::size_t axis, double coordinate) const;
    /// Calls visit(cell index) for every cell of the grid that a cube around a point touches.
    template <typename Visit>
    void forCells(const dvec3& point, double halfSide, const Visit& visit) const;

    dvec3 low_{0.0};
    double cellSize_ = 1.0;                   ///< side of a cell, m
    std::array<int, 3> cellCounts_{0, 0, 0};  ///< number of cells along each axis
    std::vector<std::uint32_t> begin_;  ///< where the list of each cell begins in lists_, and where the last one ends
    Indices lists_;
};

}  // namespace oracle
