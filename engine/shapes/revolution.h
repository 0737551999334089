// Solids of revolution: a profile in the half plane of radius and height, turned around the y axis. Cylinders, cones,
// frusta, capsules, tori, glasses, bowls and funnels are all of this kind. The distance is computed in the half plane,
// with sums, products, quotients and square roots alone, so that it is the same on every machine.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/shapes/signed_distance.h"

namespace engine {

/// A point of a profile.
struct ProfilePoint {
    double radius = 0.0;  ///< distance from the y axis, not negative, m
    double height = 0.0;  ///< y coordinate, m
};

/// A solid of revolution around the y axis through the origin.
class Revolution {
 public:
    /// The solid that a profile encloses, or a wall along it:
    /// - closed, without thickness: the inside of the polygon of the points, in either order. Edges on the axis, such
    ///   as the one that closes the profile of a cylinder, are no surface. The polygon must not cross itself.
    /// - with a half thickness: everything within that distance of the chain of the points, which is rounded at its
    ///   ends and outer corners. A single point is a torus, or a sphere on the axis. A closed chain ends at its first
    ///   point, unless both ends are on the axis, where nothing is missing.
    /// @param halfThickness  in meters; 0 for a closed polygon, otherwise positive
    /// Throws std::invalid_argument without points, if a coordinate is not finite, if a radius is negative, if a
    /// polygon has no area, and if an open chain has no thickness.
    Revolution(const std::vector<ProfilePoint>& points, bool isClosed, double halfThickness);

    /// The exact signed distance; within a wall that of the chain less half the thickness. The gradient is a unit
    /// vector everywhere: where several points of the surface are equally near, it is that of one of them, and where
    /// the radial direction is undefined, on the axis, that is x.
    SignedDistance at(const Vec3& point) const;

    /// The smallest box around the solid.
    BoundingBox bounds() const;

    /// The thickness of a wall, m; infinite for the inside of a polygon, of which it is not known.
    double thickness() const;

 private:
    /// A vector in the half plane.
    struct HalfPlaneVector {
        double radius = 0.0;
        double height = 0.0;
    };
    /// A segment of the profile. Its normal is (direction.height, -direction.radius).
    struct Edge {
        HalfPlaneVector start;                   // m
        HalfPlaneVector direction;               // unit vector from the start to the end
        double length = 0.0;                     // m; 0 for a single point
        HalfPlaneVector startNormal, endNormal;  // sum of the normals of the edges that meet there
    };
    /// The box around kBlockSize edges, of which fewer are left in the last block.
    struct Block {
        HalfPlaneVector low, high;  // m
    };
    /// The nearest point of the profile so far.
    struct Nearest {
        double distanceSq = 0.0;     // m^2
        const Edge* edge = nullptr;  // that it is on
        double along = 0.0;          // its distance from the edge's start, m
    };

    static Edge edgeBetween(const ProfilePoint& start, const ProfilePoint& end);
    void makeEdges(const std::vector<ProfilePoint>& chain, bool isRing);
    void makeBlocks();
    void searchBlock(std::size_t block, const HalfPlaneVector& point, Nearest& nearest) const;
    Nearest nearestTo(const HalfPlaneVector& point) const;
    double distanceInPlane(const HalfPlaneVector& point, HalfPlaneVector& gradient) const;

    std::vector<Edge> edges_;
    std::vector<Block> blocks_;
    bool isSolid_ = false;  // a polygon, not a wall
    double halfThickness_ = 0.0;
};

/// The points of a closed profile: a cylinder that stands on y = -height / 2. Both in meters.
std::vector<ProfilePoint> cylinderProfile(double radius, double height);

/// The points of a closed profile: a cone with its top cut off, around the middle of its height. A cone has topRadius
/// 0, and one that stands on its tip bottomRadius 0. All in meters.
std::vector<ProfilePoint> frustumProfile(double bottomRadius, double topRadius, double height);

/// The points of an open profile: a capsule whose half thickness is its radius, around the middle of its height.
/// @param height  from end to end, in meters; at least twice the radius
std::vector<ProfilePoint> capsuleProfile(double radius, double height);

}  // namespace engine
