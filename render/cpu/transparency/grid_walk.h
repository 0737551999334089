// The cells of a grid that a ray passes, one after another (Amanatides and Woo 1987). Used by field_crossing.cpp.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/glm.hpp>

#include "render/cpu/transparency/field_crossing.h"

namespace render {

class GridWalk {
 public:
    GridWalk(const BallCells& cells, const RayPart& ray) : cells_(cells), part_(ray), last_(ray.to) {
        const glm::vec3 high = cells.high();
        for (int axis = 0; axis < 3; ++axis) {
            // A ray that runs along a plane is in the slab everywhere or nowhere.
            const float slope = ray.direction[axis];
            const float least = std::numeric_limits<float>::min();
            const float inverse = 1.0F / (slope < 0.0F ? std::min(slope, -least) : std::max(slope, least));
            const float a = (cells.low[axis] - ray.origin[axis]) * inverse;
            const float b = (high[axis] - ray.origin[axis]) * inverse;
            part_.from = std::max(part_.from, std::min(a, b));
            last_ = std::min(last_, std::max(a, b));
            inverse_[axis] = inverse;
        }
        if (isOver()) return;
        const glm::vec3 first = (ray.origin + part_.from * ray.direction - cells.low) / cells.side;
        cell_ = clamp(glm::ivec3(first), glm::ivec3(0), cells.count - 1);
        findEnd();
    }

    bool isOver() const { return !(part_.from < last_); }
    glm::ivec3 cell() const { return cell_; }
    /// The part of the ray within the cell.
    const RayPart& part() const { return part_; }
    /// Where the ray leaves the grid or ends, m; below where it begins if it misses the grid.
    float end() const { return last_; }

    void next() {
        part_.from = part_.to;
        cell_[axis_] += inverse_[axis_] < 0.0F ? -1 : 1;
        if (cell_[axis_] < 0 || cell_[axis_] >= cells_.count[axis_]) part_.from = last_;
        if (!isOver()) findEnd();
    }

 private:
    /// Finds the side through which the ray leaves the cell.
    void findEnd() {
        part_.to = last_;
        for (int axis = 0; axis < 3; ++axis) {
            const int side = cell_[axis] + (inverse_[axis] < 0.0F ? 0 : 1);
            const float bound = cells_.low[axis] + static_cast<float>(side) * cells_.side;
            const float at = std::max((bound - part_.origin[axis]) * inverse_[axis], part_.from);
            if (at > part_.to) continue;
            part_.to = at;
            axis_ = axis;
        }
    }

    const BallCells& cells_;
    RayPart part_;
    float last_;
    glm::vec3 inverse_{1.0F};  // 1 / direction
    glm::ivec3 cell_{0};
    int axis_ = 0;  // along which the ray leaves the cell
};

}  // namespace render
