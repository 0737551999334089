// A uniform grid, and a walk from cell to cell along a ray (Amanatides and Woo 1987).
#include "studies/oracle/ball_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace oracle {
namespace {

using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A millionth more than a ball's own, so that no rounding of the walk loses it.
double widthOf(const Extent& ball) {
    return ball.radius * (1.0 + 1e-6);
}

struct Stretch {
    double enter = 0.0;
    double exit = kInfinity;
};

/// Where the ray, from its origin on, is inside of a box; exit < enter where nowhere.
Stretch insideBox(const Ray& ray, const dvec3& low, const dvec3& high) {
    Stretch stretch;
    for (int axis = 0; axis < 3; ++axis) {
        if (ray.direction[axis] == 0.0) {
            if (ray.origin[axis] < low[axis] || ray.origin[axis] > high[axis]) return {0.0, -1.0};
            continue;
        }
        const double a = (low[axis] - ray.origin[axis]) / ray.direction[axis];
        const double b = (high[axis] - ray.origin[axis]) / ray.direction[axis];
        stretch.enter = std::max(stretch.enter, std::min(a, b));
        stretch.exit = std::min(stretch.exit, std::max(a, b));
    }
    return stretch;
}

Indices onceEach(Indices found) {
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// Of `count` cells along an axis the one nearest to a place, in cells; around a single ball they are tiny.
int cellWithin(double place, int count) {
    return static_cast<int>(std::clamp(std::floor(place), 0.0, static_cast<double>(count - 1)));
}

}  // namespace

BallGrid BallGrid::everyone(std::size_t count) {
    BallGrid crowd;
    crowd.all_ = true;
    crowd.count_ = static_cast<std::uint32_t>(count);
    return crowd;
}

BallGrid::BallGrid(const std::vector<Extent>& balls) : count_(static_cast<std::uint32_t>(balls.size())) {
    if (balls.empty()) return;
    dvec3 high(-kInfinity);
    low_ = dvec3(kInfinity);
    double sum = 0.0;
    for (const Extent& ball : balls) {
        const double width = widthOf(ball);
        low_ = glm::min(low_, ball.center - width);
        high = glm::max(high, ball.center + width);
        sum += width;
    }
    const dvec3 extent = high - low_;
    // As wide as a mean ball, and no more than some hundred cells an axis.
    cellSize_ = std::max({2.0 * sum / count_, std::max({extent.x, extent.y, extent.z}) / 128.0, 1e-9});
    for (std::size_t axis = 0; axis < 3; ++axis)
        cells_[axis] = static_cast<int>(extent[static_cast<int>(axis)] / cellSize_) + 1;
    const auto forCellsOf = [&](const Extent& ball, const auto& visit) {
        const double width = widthOf(ball);
        std::array<int, 3> first{};
        std::array<int, 3> last{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int k = static_cast<int>(axis);
            const double at = ball.center[k] - low_[k];
            first[axis] = std::clamp(static_cast<int>((at - width) / cellSize_), 0, cells_[axis] - 1);
            last[axis] = std::clamp(static_cast<int>((at + width) / cellSize_), 0, cells_[axis] - 1);
        }
        for (int z = first[2]; z <= last[2]; ++z)
            for (int y = first[1]; y <= last[1]; ++y)
                for (int x = first[0]; x <= last[0]; ++x) visit(cellAt({x, y, z}));
    };
    begin_.assign(cellAt({0, 0, cells_[2]}) + 1, 0);
    for (const Extent& ball : balls) forCellsOf(ball, [&](std::size_t cell) { ++begin_[cell + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    lists_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t k = 0; k < count_; ++k)
        forCellsOf(balls[k], [&](std::size_t cell) { lists_[next[cell]++] = k; });
}

std::size_t BallGrid::cellAt(const std::array<int, 3>& cell) const {
    return (static_cast<std::size_t>(cell[2]) * static_cast<std::size_t>(cells_[1]) +
            static_cast<std::size_t>(cell[1])) *
               static_cast<std::size_t>(cells_[0]) +
           static_cast<std::size_t>(cell[0]);
}

Indices BallGrid::along(const Ray& ray) const {
    Indices found;
    if (all_) {
        found.resize(count_);
        std::iota(found.begin(), found.end(), 0U);
        return found;
    }
    const dvec3 high = low_ + cellSize_ * dvec3(cells_[0], cells_[1], cells_[2]);
    const Stretch stretch = insideBox(ray, low_, high);
    if (count_ == 0 || stretch.exit < stretch.enter) return found;
    const dvec3 start = (ray.origin + stretch.enter * ray.direction - low_) / cellSize_;
    std::array<int, 3> cell{};
    std::array<double, 3> next{};  // distance along the ray, in cells, at which it leaves the cell along the axis
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int k = static_cast<int>(axis);
        cell[axis] = cellWithin(start[k], cells_[axis]);
        const double slope = ray.direction[k];
        const double border = cell[axis] + (slope > 0.0 ? 1.0 : 0.0);
        next[axis] = slope == 0.0 ? kInfinity : (border - start[k]) / slope;
    }
    while (true) {
        const std::size_t place = cellAt(cell);
        found.insert(found.end(), lists_.begin() + begin_[place], lists_.begin() + begin_[place + 1]);
        const auto axis = static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
        const double slope = ray.direction[static_cast<int>(axis)];
        cell[axis] += slope > 0.0 ? 1 : -1;
        if (next[axis] == kInfinity || cell[axis] < 0 || cell[axis] >= cells_[axis]) break;
        next[axis] += 1.0 / std::abs(slope);
    }
    return onceEach(std::move(found));
}

Indices BallGrid::within(const dvec3& place, double halfSide) const {
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = place[static_cast<int>(axis)] - low_[static_cast<int>(axis)];
        first[axis] = cellWithin((at - halfSide) / cellSize_, cells_[axis]);
        last[axis] = cellWithin((at + halfSide) / cellSize_, cells_[axis]);
    }
    Indices found;
    for (int z = first[2]; z <= last[2]; ++z)
        for (int y = first[1]; y <= last[1]; ++y)
            for (int x = first[0]; x <= last[0]; ++x) {
                const std::size_t cell = cellAt({x, y, z});
                found.insert(found.end(), lists_.begin() + begin_[cell], lists_.begin() + begin_[cell + 1]);
            }
    return onceEach(std::move(found));
}

}  // namespace oracle
