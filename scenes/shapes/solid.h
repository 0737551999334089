// Solids of any form at their places in a scene: which points are inside, how large they are. Bodies are filled by
// them.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "engine/shapes/distance_grid.h"
#include "engine/shapes/revolution.h"
#include "scenes/shapes/extrusion.h"

namespace scenes {

/// A box around the origin.
struct Cuboid {
    engine::Vec3 halfSize = engine::Vec3::Zero();  ///< half the edge lengths, m

    /// Signed distance of a point, m.
    double distance(const engine::Vec3& point) const;
};

/// What tells how far a solid reaches in any direction.
struct Silhouette {
    std::vector<engine::ProfilePoint> circles;  ///< around the y axis
    std::vector<engine::Vec3> points;           ///< m
    double margin = 0.0;                        ///< by which the solid reaches further than both, m

    /// The largest coordinate along a unit vector, m.
    double reach(const engine::Vec3& direction) const;
};

/// Where a shape is, and which way it is turned.
struct Placement {
    engine::Vec3 center = engine::Vec3::Zero();              ///< of the shape's own origin, m
    engine::Matrix3 rotation = engine::Matrix3::Identity();  ///< from the shape's coordinates to the scene's
};

/// A solid at its place.
class Solid {
 public:
    using Shape = std::variant<Cuboid, engine::Revolution, engine::DistanceGrid, Extrusion>;

    /// @param thickness  of the wall that is left of a hollow solid, in m; 0 for a full one
    Solid(Shape shape, Silhouette silhouette, Placement placement, double thickness)
        : shape_(std::move(shape)), silhouette_(std::move(silhouette)), placement_(placement), thickness_(thickness) {}

    /// Signed distance of a point from the solid, m: negative inside, at most the distance outside.
    double distance(const engine::Vec3& point) const;

    /// How far the solid reaches along a unit vector, m: the largest product of it and a point of the solid.
    double reach(const engine::Vec3& direction) const;

    engine::BoundingBox bounds() const;

 private:
    Shape shape_;
    Silhouette silhouette_;
    Placement placement_;
    double thickness_ = 0.0;
};

Solid ballSolid(double radius, const Placement& placement, double thickness);
Solid cuboidSolid(const engine::Vec3& size, const Placement& placement, double thickness);
/// @param profile  as engine::Revolution takes it
Solid revolutionSolid(const std::vector<engine::ProfilePoint>& profile, bool isClosed, double halfThickness,
                      const Placement& placement, double hollowThickness);
/// A solid without an inside that reaches as far as some points, for reach() alone.
Solid pointSolid(std::vector<engine::Vec3> points, const Placement& placement);
Solid extrusionSolid(Extrusion extrusion, const Placement& placement, double thickness);

/// The volume of a solid in m^3, from samples on a grid of 48 points along each edge of its bounds: to a few percent,
/// unless it is much thinner than they are apart.
double estimatedVolume(const Solid& solid);

}  // namespace scenes
