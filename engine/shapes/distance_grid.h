// Distances on a grid of voxels near a surface, for shapes without a closed form, such as meshes. The grid is sparse:
// bricks of voxels, stored where the surface is near or the inside is. Plain data: what makes it is elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/shapes/signed_distance.h"

namespace engine {

/// Voxels along the edge of a brick. The corners of its voxels are one more, and neighbors share those on their face.
inline constexpr int kBrickVoxels = 8;
inline constexpr int kBrickNodes = kBrickVoxels + 1;

/// The values of a distance grid at the corners of its voxels.
struct DistanceBricks {
    static constexpr std::uint32_t kNone = 0xffffffffU;  ///< index of a brick that is not stored

    Vec3 origin = Vec3::Zero();                       ///< of the corner with the smallest coordinates, m
    double voxel = 1.0;                               ///< edge of a voxel, m
    float band = 3.0F;                                ///< largest value, and the value wherever no brick is stored, m
    std::array<std::uint32_t, 3> counts = {0, 0, 0};  ///< bricks along x, y and z
    std::vector<std::uint32_t> brickOf;               ///< index of each brick, kNone if it is outside; x is fastest
    std::vector<float> values;                        ///< kBrickNodes^3 for each brick, m; x is fastest
};

/// Signed distances that are interpolated between the corners of voxels.
class DistanceGrid {
 public:
    /// The surface must be at least a band away from the faces of the grid's box, and neighbors must agree on the
    /// values of their common corners; where a neighbor is not stored, they must be the band. Throws
    /// std::invalid_argument if the sizes do not fit together.
    explicit DistanceGrid(DistanceBricks bricks);

    /// The value at a point, in m, and its exact gradient, which is not of unit length: a force that is a function of
    /// the value times the gradient conserves energy. The value is continuous. Where no brick is stored it is the band,
    /// with gradient zero; outside the grid's box it is the band plus the distance from the box, which is a lower bound
    /// of the distance from the surface.
    SignedDistance at(const Vec3& point) const;

    /// The box of the grid, which is at least a band larger than the shape.
    const BoundingBox& bounds() const { return bounds_; }

    const DistanceBricks& bricks() const { return bricks_; }

 private:
    SignedDistance outside(const Vec3& point) const;

    DistanceBricks bricks_;
    BoundingBox bounds_;
    double perVoxel_ = 1.0;  // 1 / voxel
};

/// Voxels of the bricks that are stored.
std::size_t voxelCount(const DistanceBricks& bricks);

/// Memory of the values and the table of bricks, in bytes.
std::size_t memoryOf(const DistanceBricks& bricks);

}  // namespace engine
