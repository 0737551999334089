// Axis-aligned bounding box of a set of vectors: positions, displacements or velocities. The distance from its middle
// bounds how much a vector differs from what all vectors have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/core/parallel.h"
#include "engine/core/vec3.h"

namespace engine {

struct BoundingBox {
    Vec3 low;   ///< smallest coordinates of the box
    Vec3 high;  ///< largest coordinates of the box

    /// A box without bounds, which contains every vector.
    static BoundingBox unbounded() {
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        return {Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
    }

    /// A box that contains nothing: its lower bounds are plus infinity, its upper ones minus infinity.
    static BoundingBox empty() {
        const BoundingBox all = unbounded();
        return {all.high, all.low};
    }

    /// Whether a vector is inside the box or on its surface; a NaN is not.
    bool contains(const Vec3& vector) const {
        return (vector.array() >= low.array()).all() && (vector.array() <= high.array()).all();
    }

    Vec3 middle() const { return 0.5 * (low + high); }

    /// Whether a point is nearer to the box than `reach`, or insignificantly further away. A cheap test, without a
    /// square root, that excludes what is far away.
    bool isNear(const Vec3& point, double reach) const {
        constexpr double kSlack = 1.0 + 1e-9;  // margin of the test; chosen: far above its rounding errors
        return squaredLength(point - point.cwiseMax(low).cwiseMin(high)) < kSlack * reach * reach;
    }

    /// Extends the box to contain another.
    void include(const BoundingBox& other) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], other.low[axis]);
            high[axis] = std::max(high[axis], other.high[axis]);
        }
    }
};

/// The bounding box of the vectors vectorOf(0) to vectorOf(count - 1); BoundingBox::empty() if there are none.
template <class VectorOf>
BoundingBox boundingBoxOf(std::size_t count, const VectorOf& vectorOf) {
    const auto boxOf = [&](std::size_t begin, std::size_t end) {
        const Vec3 first = vectorOf(begin);
        BoundingBox box{first, first};
        for (std::size_t index = begin + 1; index < end; ++index) {
            const Vec3 vector = vectorOf(index);
            box.include({vector, vector});
        }
        return box;
    };
    BoundingBox box = BoundingBox::empty();
    for (const BoundingBox& part : resultsOfChunks<BoundingBox>(count, boxOf)) box.include(part);
    return box;
}

/// The largest distance of the vectors vectorOf(0) to vectorOf(count - 1) from a given vector; a NaN counts as
/// infinitely far.
template <class VectorOf>
double farthestFrom(const Vec3& from, std::size_t count, const VectorOf& vectorOf) {
    return std::sqrt(largestOver(count, [&](std::size_t index) {
        const double distanceSq = squaredLength(vectorOf(index) - from);
        return std::isnan(distanceSq) ? std::numeric_limits<double>::infinity() : distanceSq;
    }));
}

/// Whether all vectors vectorOf(0) to vectorOf(count - 1) are within a distance from a given vector; a NaN is not.
template <class VectorOf>
bool areWithin(double distance, const Vec3& from, std::size_t count, const VectorOf& vectorOf) {
    return holdsInRanges(count, kParticleGrain, [&](std::size_t begin, std::size_t end) {
        bool areNear = true;  // combined without a branch, so that the loop vectorizes
        for (std::size_t index = begin; index < end; ++index)
            areNear &= squaredLength(vectorOf(index) - from) <= distance * distance;
        return areNear;
    });
}

}  // namespace engine
