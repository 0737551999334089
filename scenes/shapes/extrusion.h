// Flat outlines, of letters or of the dark parts of an image, that are given a depth.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/bounding_box.h"

namespace scenes {

using OutlinePoint = std::array<double, 2>;  ///< x and y, m

/// The edges of closed polygons, in any order; of neighbors the ends are equal.
struct Outline {
    std::vector<std::array<OutlinePoint, 2>> edges;
    /// Whether all is inside around which the polygons wind, as strokes of a letter that overlap, instead of what an
    /// odd number of polygons encloses.
    bool isByWinding = false;
};

/// An outline in the plane of x and y, extruded by half its depth to either side along z.
class Extrusion {
 public:
    Extrusion(const Outline& outline, double depth);

    /// The exact signed distance of a point, m.
    double distance(const engine::Vec3& point) const;

    engine::BoundingBox bounds() const;

    /// Whether the outline encloses nothing at all.
    bool isEmpty() const { return edges_.empty(); }

 private:
    struct Edge {
        OutlinePoint start, end;
    };
    /// The box around consecutive edges.
    struct Block {
        OutlinePoint low, high;
    };

    double outlineDistance(double x, double y) const;

    std::vector<Edge> edges_;
    std::vector<Block> blocks_;
    bool isByWinding_ = false;
    double halfDepth_ = 0.0;
};

}  // namespace scenes
