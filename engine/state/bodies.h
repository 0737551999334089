// Fills the shapes of bodies with particles at time zero. Called by scenes/; the simulation itself knows only the
// particles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/core/bounding_box.h"

namespace engine {

/// Spacing and jitter of the particles that fill a body.
struct Packing {
    double spacing = 0.3;    ///< distance of nearest neighbors, m
    double jitter = 0.0;     ///< largest random displacement of a coordinate, in spacings
    std::uint64_t seed = 1;  ///< seed of the random displacements
    /// Number of layers that take the place of each layer of a box's lattice. The spacing above is the one after that.
    double refinement = 1.0;
};

/// Number of layers of a box's lattice along each axis, whole numbers. The layers are spacing / sqrt(2) apart. A
/// refined box is filled with as many layers as keep its volume, so that the outermost ones may be slightly beyond its
/// faces.
Vec3 boxLayers(const Vec3& minimum, const Vec3& maximum, const Packing& packing);

/// Face-centered cubic positions inside a ball, in meters.
std::vector<Vec3> ballPositions(const Vec3& center, double radius, const Packing& packing);

/// Face-centered cubic positions inside an axis-aligned box, in meters.
std::vector<Vec3> boxPositions(const Vec3& minimum, const Vec3& maximum, const Packing& packing);

/// Face-centered cubic positions inside a shape of any form, in meters: those where its distance is not positive. The
/// lattice has a point in the middle of the bounds.
/// @param bounds  of the shape, m
/// @param distance  signed distance of a point from the shape, m; outside, at most the distance
/// @param most  number of positions after which no more are looked for
std::vector<Vec3> positionsInside(const BoundingBox& bounds, const std::function<double(const Vec3&)>& distance,
                                  const Packing& packing, std::size_t most);

/// A cubic lattice of counts[0] x counts[1] x counts[2] positions around a center, in meters.
/// A direction with a single layer gets no jitter, so that a planar body stays planar.
std::vector<Vec3> gridPositions(const Vec3& center, const std::array<std::uint32_t, 3>& counts, const Packing& packing);

}  // namespace engine
