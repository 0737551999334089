// The cells of a grid that a ray passes, one after another (Amanatides and Woo 1987). Used by field_crossing.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/glm.hpp>

#include "render/cpu/transparency/field_crossing.h"

namespace render {

/// A grid of cubes in space.
struct CubeGrid {
    glm::vec3 low{0.0F};  ///< corner of the first cell, m
    float side = 1.0F;    ///< of a cell, m
    glm::ivec3 count{0};  ///< number of cells along each axis
};

/// 1 / direction, finite. A ray that runs along a plane is in the slab beside it everywhere or nowhere.
inline glm::vec3 inverseOf(glm::vec3 direction) {
    glm::vec3 inverse;
    for (int axis = 0; axis < 3; ++axis) {
        const float slope = direction[axis];
        const float least = std::numeric_limits<float>::min();
        inverse[axis] = 1.0F / (slope < 0.0F ? std::min(slope, -least) : std::max(slope, least));
    }
    return inverse;
}

class GridWalk {
 public:
    /// @param inverse  that of the ray's direction
    GridWalk(const CubeGrid& grid, const RayPart& ray, glm::vec3 inverse) : from_(ray.from), last_(ray.to) {
        const glm::vec3 a = (grid.low - ray.origin) * inverse;
        const glm::vec3 b = a + grid.side * glm::vec3(grid.count) * inverse;
        const glm::vec3 enters = min(a, b);
        const glm::vec3 leaves = max(a, b);
        from_ = std::max({from_, enters.x, enters.y, enters.z});
        last_ = std::min({last_, leaves.x, leaves.y, leaves.z});
        if (isOver()) return;
        const glm::vec3 first = (ray.origin + from_ * ray.direction - grid.low) * (1.0F / grid.side);
        const glm::ivec3 stride(1, grid.count.x, grid.count.x * grid.count.y);
        for (int axis = 0; axis < 3; ++axis) {
            const int cell = std::clamp(static_cast<int>(first[axis]), 0, grid.count[axis] - 1);
            cell_[axis] = cell;
            const bool isDown = inverse[axis] < 0.0F;
            index_ += cell * stride[axis];
            sign_[axis] = isDown ? -1 : 1;
            step_[axis] = isDown ? -stride[axis] : stride[axis];
            left_[axis] = isDown ? cell : grid.count[axis] - 1 - cell;
            spacing_[axis] = grid.side * std::abs(inverse[axis]);
            next_[axis] = a[axis] + static_cast<float>(isDown ? cell : cell + 1) * (grid.side * inverse[axis]);
        }
        findEnd();
    }

    bool isOver() const { return !(from_ < last_); }
    glm::ivec3 cell() const { return cell_; }
    /// Number of the cell, x fastest.
    std::size_t index() const { return static_cast<std::size_t>(index_); }
    /// Distances at which the ray enters the cell and leaves it.
    float from() const { return from_; }
    float to() const { return to_; }
    /// Where the ray leaves the grid or ends, m; below where it begins if it misses the grid.
    float end() const { return last_; }

    void next() {
        from_ = left_[axis_]-- > 0 ? to_ : last_;
        cell_[axis_] += sign_[axis_];
        index_ += step_[axis_];
        next_[axis_] += spacing_[axis_];
        findEnd();
    }

 private:
    /// Finds the side through which the ray leaves the cell.
    void findEnd() {
        // Without branches, which no processor could predict.
        const int ofFirstTwo = static_cast<int>(next_.y < next_.x);
        const float nearer = std::min(next_.x, next_.y);
        const int isThird = static_cast<int>(next_.z < nearer);
        axis_ = 2 * isThird + (1 - isThird) * ofFirstTwo;
        to_ = std::max(std::min(std::min(nearer, next_.z), last_), from_);
    }

    float from_, to_ = 0.0F, last_;
    glm::vec3 next_{0.0F};     // where the ray leaves the cell along each axis
    glm::vec3 spacing_{0.0F};  // between such places
    glm::ivec3 cell_{0};
    glm::ivec3 sign_{0};  // 1 or -1: from a cell to the next along each axis
    glm::ivec3 step_{0};  // from the index of a cell to that of the next along each axis
    glm::ivec3 left_{0};  // number of cells that follow along each axis
    int index_ = 0;
    int axis_ = 0;  // along which the ray leaves the cell
};

}  // namespace render
