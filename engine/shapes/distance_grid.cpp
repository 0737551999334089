#include "engine/shapes/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace engine {
namespace {

constexpr std::size_t kValuesPerBrick = std::size_t{kBrickNodes} * kBrickNodes * kBrickNodes;

double mix(double low, double high, double share) {
    return low + share * (high - low);
}

/// The value at a place within a voxel, and its derivatives by the coordinates of the place, which are between 0 and 1.
SignedDistance interpolate(const float* corner, double x, double y, double z) {
    constexpr int kRow = kBrickNodes;
    constexpr int kLayer = kBrickNodes * kBrickNodes;
    const auto along = [&](int offset) { return mix(corner[offset], corner[offset + 1], x); };
    const auto slope = [&](int offset) { return static_cast<double>(corner[offset + 1]) - corner[offset]; };
    const double near0 = along(0);
    const double near1 = along(kRow);
    const double far0 = along(kLayer);
    const double far1 = along(kLayer + kRow);
    const double nearValue = mix(near0, near1, y);
    const double farValue = mix(far0, far1, y);
    SignedDistance result;
    result.value = mix(nearValue, farValue, z);
    result.gradient = {
        mix(mix(slope(0), slope(kRow), y), mix(slope(kLayer), slope(kLayer + kRow), y), z),
        mix(near1 - near0, far1 - far0, z),
        farValue - nearValue,
    };
    return result;
}

}  // namespace

DistanceGrid::DistanceGrid(DistanceBricks bricks) : bricks_(std::move(bricks)), perVoxel_(1.0 / bricks_.voxel) {
    const auto& counts = bricks_.counts;
    const std::size_t brickCount = std::size_t{counts[0]} * counts[1] * counts[2];
    const std::size_t stored = bricks_.values.size() / kValuesPerBrick;
    const bool areKnown = std::ranges::all_of(
        bricks_.brickOf, [&](std::uint32_t brick) { return brick == DistanceBricks::kNone || brick < stored; });
    if (brickCount == 0 || bricks_.brickOf.size() != brickCount || bricks_.values.size() % kValuesPerBrick != 0 ||
        !areKnown || !(bricks_.voxel > 0.0) || !(bricks_.band > 0.0F))
        throw std::invalid_argument("the bricks of a distance grid do not fit its size");
    const double brickEdge = kBrickVoxels * bricks_.voxel;
    bounds_ = {bricks_.origin, bricks_.origin + brickEdge * Vec3(counts[0], counts[1], counts[2])};
}

SignedDistance DistanceGrid::at(const Vec3& point) const {
    if (!bounds_.contains(point)) return outside(point);
    std::array<std::uint32_t, 3> brick{};
    std::array<int, 3> voxel{};
    std::array<double, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<int>(axis);
        const double scaled = (point[index] - bricks_.origin[index]) * perVoxel_;
        // Rounding may give the box's upper face, which belongs to the last voxel, and a little more.
        const std::uint32_t last = bricks_.counts[axis] * kBrickVoxels - 1;
        const std::uint32_t cell = std::min(static_cast<std::uint32_t>(scaled), last);
        brick[axis] = cell / kBrickVoxels;
        voxel[axis] = static_cast<int>(cell % kBrickVoxels);
        place[axis] = std::min(scaled - cell, 1.0);
    }
    const std::size_t row = std::size_t{brick[2]} * bricks_.counts[1] + brick[1];
    const std::uint32_t stored = bricks_.brickOf[row * bricks_.counts[0] + brick[0]];
    if (stored == DistanceBricks::kNone) return {bricks_.band, Vec3::Zero()};
    const auto corner = static_cast<std::size_t>((voxel[2] * kBrickNodes + voxel[1]) * kBrickNodes + voxel[0]);
    SignedDistance result =
        interpolate(&bricks_.values[stored * kValuesPerBrick + corner], place[0], place[1], place[2]);
    result.gradient *= perVoxel_;
    return result;
}

SignedDistance DistanceGrid::outside(const Vec3& point) const {
    const Vec3 away = point - point.cwiseMax(bounds_.low).cwiseMin(bounds_.high);
    const double distance = std::sqrt(squaredLength(away));
    // Closer than a square root of the smallest number, or NaN.
    if (!(distance > 0.0)) return {bricks_.band + distance, Vec3::Zero()};
    return {bricks_.band + distance, away / distance};
}

std::size_t voxelCount(const DistanceBricks& bricks) {
    return bricks.values.size() / kValuesPerBrick * (std::size_t{kBrickVoxels} * kBrickVoxels * kBrickVoxels);
}

std::size_t memoryOf(const DistanceBricks& bricks) {
    return bricks.values.size() * sizeof(float) + bricks.brickOf.size() * sizeof(std::uint32_t);
}

}  // namespace engine
