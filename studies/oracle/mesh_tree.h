// The triangles of a view's mesh obstacles in a tree of bounding boxes, so that a ray of the oracle tries only
// triangles that it may meet. Used by the oracle; it shares nothing with the renderers' ways to find triangles, which
// it judges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "studies/oracle/intersections.h"

namespace oracle {

/// A triangle of a mesh obstacle in world coordinates.
struct MeshTriangle {
    std::array<dvec3, 3> corners;  ///< counterclockwise as seen from outside, m
    std::array<dvec3, 3> normals;  ///< outward normals at the corners, unit length
    dvec3 color{0.0};
    render::Medium medium;
};

class MeshTree {
 public:
    explicit MeshTree(const render::View& view);

    /// The nearest point of a triangle along a ray; Kind::none if there is none. The normal is interpolated between
    /// the corners, and turned around where the ray meets the inner side of the triangle.
    Hit nearest(const Ray& ray) const;
    /// Whether a ray meets the outer side of any triangle of an opaque mesh, through which it enters a solid.
    bool isEntered(const Ray& ray) const;

 private:
    /// A box around the triangles first ... first + count - 1. An inner node has its two children one after another.
    struct Node {
        dvec3 low{kInfinity};
        dvec3 high{-kInfinity};
        std::size_t first = 0;
        std::size_t count = 0;
        std::size_t children = 0;  ///< index of the first of the two children; 0 for a leaf
    };

    void split(std::size_t node);
    void trace(std::size_t node, const Ray& ray, bool outerOnly, Hit& best) const;

    std::vector<MeshTriangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace oracle
