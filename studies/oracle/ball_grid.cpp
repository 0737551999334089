// Sorts balls into cells by a counting sort, and walks along a ray (Amanatides and Woo 1987). See ball_grid.h.
#include "studies/oracle/ball_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace oracle {
namespace {

/// The radius of a ball enlarged by a millionth, so that no ball is lost to rounding errors of the walk along a ray.
double safeRadius(const Extent& ball) {
    return ball.radius * (1.0 + 1e-6);
}

Indices sortedWithoutDuplicates(Indices found) {
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace

BallGrid::BallGrid(const std::vector<Extent>& balls) {
    if (balls.empty()) return;
    dvec3 high(-kInfinity);
    low_ = dvec3(kInfinity);
    double sum = 0.0;
    for (const Extent& ball : balls) {
        low_ = glm::min(low_, ball.center - safeRadius(ball));
        high = glm::max(high, ball.center + safeRadius(ball));
        sum += safeRadius(ball);
    }
    const dvec3 extent = high - low_;
    // Cells are as wide as the mean ball, but there are at most 129 of them along an axis. Chosen for speed.
    cellSize_ = std::max(
        {2.0 * sum / static_cast<double>(balls.size()), std::max({extent.x, extent.y, extent.z}) / 128.0, 1e-9});
    for (std::size_t axis = 0; axis < 3; ++axis)
        cellCounts_[axis] = static_cast<int>(extent[static_cast<int>(axis)] / cellSize_) + 1;
    begin_.assign(cellIndex({0, 0, cellCounts_[2]}) + 1, 0);
    for (const Extent& ball : balls)
        forCells(ball.center, safeRadius(ball), [&](std::size_t cell) { ++begin_[cell + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    lists_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t k = 0; k < balls.size(); ++k)
        forCells(balls[k].center, safeRadius(balls[k]), [&](std::size_t cell) { lists_[next[cell]++] = k; });
}

std::size_t BallGrid::cellIndex(const Cell& cell) const {
    const auto [x, y, z] = cell;
    return static_cast<std::size_t>((z * cellCounts_[1] + y) * cellCounts_[0] + x);
}

int BallGrid::cellAlong(std::size_t axis, double coordinate) const {
    const double cell = std::floor((coordinate - low_[static_cast<int>(axis)]) / cellSize_);
    return static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(cellCounts_[axis] - 1)));
}

template <typename Visit>
void BallGrid::forCells(const dvec3& point, double halfSide, const Visit& visit) const {
    Cell first{};
    Cell last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = cellAlong(axis, point[static_cast<int>(axis)] - halfSide);
        last[axis] = cellAlong(axis, point[static_cast<int>(axis)] + halfSide);
    }
    for (int z = first[2]; z <= last[2]; ++z)
        for (int y = first[1]; y <= last[1]; ++y)
            for (int x = first[0]; x <= last[0]; ++x) visit(cellIndex({x, y, z}));
}

Indices BallGrid::along(const Ray& ray) const {
    Indices found;
    if (lists_.empty()) return found;
    const BoxInterval inside =
        boxInterval(ray, low_, low_ + cellSize_ * dvec3(cellCounts_[0], cellCounts_[1], cellCounts_[2]));
    const double enter = std::max(inside.enter, 0.0);
    if (inside.exit < enter) return found;
    const dvec3 start = ray.origin + enter * ray.direction;
    Cell cell{};
    std::array<double, 3> next{};  // distance from `start` to the cell's border along each axis, m along the ray
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int k = static_cast<int>(axis);
        cell[axis] = cellAlong(axis, start[k]);
        const double slope = ray.direction[k];
        const double border = low_[k] + cellSize_ * (cell[axis] + (slope > 0.0 ? 1.0 : 0.0));
        next[axis] = slope == 0.0 ? kInfinity : (border - start[k]) / slope;
    }
    while (true) {
        const std::size_t index = cellIndex(cell);
        found.insert(found.end(), lists_.begin() + begin_[index], lists_.begin() + begin_[index + 1]);
        const auto axis = static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
        const double slope = ray.direction[static_cast<int>(axis)];
        cell[axis] += slope > 0.0 ? 1 : -1;
        if (next[axis] == kInfinity || cell[axis] < 0 || cell[axis] >= cellCounts_[axis]) break;
        next[axis] += cellSize_ / std::abs(slope);
    }
    return sortedWithoutDuplicates(std::move(found));
}

Indices BallGrid::within(const dvec3& point, double halfSide) const {
    Indices found;
    forCells(point, halfSide, [&](std::size_t cell) {
        found.insert(found.end(), lists_.begin() + begin_[cell], lists_.begin() + begin_[cell + 1]);
    });
    return sortedWithoutDuplicates(std::move(found));
}

}  // namespace oracle
