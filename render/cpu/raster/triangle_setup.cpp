// Where all corners of a triangle lie before the eye, its edge functions come from the places of the corners on the
// picture. Otherwise let P0, P1, P2 be the corners in homogeneous coordinates of the picture, and d = (x, y, 1) a point
// of it. The ray through the point meets the plane of the triangle at l0 P0 + l1 P1 + l2 P2 = t d, from which by
// Cramer's rule
//   l0 = t dot(d, cross(P1, P2)) / det,  and l1, l2 likewise,  with  det = dot(P0, cross(P1, P2)),
// so that the ray meets the triangle before the eye where the three edge functions dot(d, cross(Pi, Pj)) have the sign
// of det. Nothing needs to be clipped at the eye's plane (Olano and Greer 1997, triangle scan conversion using 2D
// homogeneous coordinates). As l0 + l1 + l2 = 1, the sum of the edge functions over det is 1/t, and t the view depth.
//
// Two triangles that share an edge have the same edge function for it, but for the sign: rounding opens no gap between
// them, unless a part of just one of them lies behind the eye.
#include "render/cpu/raster/triangle_setup.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/cpu/raster/mesh_tiles.h"

namespace render {

namespace {

/// A power of two about as large as 1 / a positive number.
double inversePowerOfTwo(double number) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(number) >> 52U & 0x7ffU;
    return std::bit_cast<double>(std::clamp<std::uint64_t>(2046U - exponent, 1U, 2046U) << 52U);
}

void setFunction(TriangleGroup::Functions& functions, std::size_t k, const glm::dvec3& function) {
    functions.x[k] = static_cast<float>(function.x);
    functions.y[k] = static_cast<float>(function.y);
    functions.z[k] = static_cast<float>(function.z);
}

/// Sets the functions of a triangle of which a part lies behind the eye.
/// @param k  the triangle's number in the group
void setUpCut(const SolidGeometry& geometry, const DrawnTriangle& triangle, glm::dvec2 corner, std::size_t k,
              TriangleGroup& group) {
    using glm::dvec3;
    std::array<dvec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c)
        points[c] = homogeneousOnPicture(geometry.frame, geometry.meshes->meshes->positions[triangle.corners[c]]);
    const std::array<dvec3, 3> planes{cross(points[1], points[2]), cross(points[2], points[0]),
                                      cross(points[0], points[1])};
    const double volume = dot(points[0], planes[0]);
    const auto atCorner = [&](const dvec3& plane) {
        return dvec3(plane.x, plane.y, plane.x * corner.x + plane.y * corner.y + plane.z);
    };
    double most = 0.0;
    for (const dvec3& plane : planes) {
        const dvec3 edge = abs(atCorner(plane));
        most = std::max({most, edge.x, edge.y, edge.z});
    }
    // Scaling by a power of two rounds nothing, so that the functions of a shared edge stay the same.
    const double scale = std::copysign(inversePowerOfTwo(most), volume);
    for (std::size_t e = 0; e < 3; ++e) setFunction(group.edges[e], k, scale * atCorner(planes[e]));
    setFunction(group.depth, k, atCorner(planes[0] + planes[1] + planes[2]) / volume);
}

/// The corners of a group's triangles on the picture, as in MeshTiles but from the tile's corner. One array for each
/// coordinate lets compilers vectorize the loops over the triangles.
struct GroupCorners {
    struct Points {
        TriangleGroup::Values x{}, y{}, z{};

        void set(std::size_t k, const glm::vec3& point) {
            x[k] = point.x;
            y[k] = point.y;
            z[k] = point.z;
        }
    };
    Points a, b, c;
};

void setEdges(const GroupCorners& corners, TriangleGroup& group) {
    using Points = GroupCorners::Points;
    const auto& [a, b, c] = corners;
    TriangleGroup::Values side;
    for (std::size_t k = 0; k < TriangleGroup::kMost; ++k) {
        const float area = (b.x[k] - a.x[k]) * (c.y[k] - a.y[k]) - (b.y[k] - a.y[k]) * (c.x[k] - a.x[k]);
        side[k] = area < 0.0F ? -1.0F : 1.0F;
    }
    const auto setEdge = [&](const Points& from, const Points& to, TriangleGroup::Functions& edge) {
        for (std::size_t k = 0; k < TriangleGroup::kMost; ++k) {
            edge.x[k] = side[k] * (from.y[k] - to.y[k]);
            edge.y[k] = side[k] * (to.x[k] - from.x[k]);
            edge.z[k] = side[k] * (from.x[k] * to.y[k] - to.x[k] * from.y[k]);
        }
    };
    setEdge(b, c, group.edges[0]);
    setEdge(c, a, group.edges[1]);
    setEdge(a, b, group.edges[2]);
}

/// In double precision, because far from its nearest corner 1 / view depth is a small difference.
void setDepths(const GroupCorners& corners, TriangleGroup& group) {
    const auto& [a, b, c] = corners;
    for (std::size_t k = 0; k < TriangleGroup::kMost; ++k) {
        const double firstX = b.x[k] - a.x[k];
        const double firstY = b.y[k] - a.y[k];
        const double firstZ = b.z[k] - a.z[k];
        const double secondX = c.x[k] - a.x[k];
        const double secondY = c.y[k] - a.y[k];
        const double secondZ = c.z[k] - a.z[k];
        const double inverse = 1.0 / (firstX * secondY - firstY * secondX);
        const double across = (firstZ * secondY - secondZ * firstY) * inverse;
        const double down = (secondZ * firstX - firstZ * secondX) * inverse;
        group.depth.x[k] = static_cast<float>(across);
        group.depth.y[k] = static_cast<float>(down);
        group.depth.z[k] = static_cast<float>(double(a.z[k]) - across * double(a.x[k]) - down * double(a.y[k]));
    }
}

}  // namespace

TriangleGroup triangleGroup(const SolidGeometry& geometry, std::span<const std::uint32_t> indices, glm::vec2 corner) {
    const MeshTiles& meshes = *geometry.meshes;
    const glm::vec3 tile(corner, 0.0F);
    TriangleGroup group;
    GroupCorners corners;
    bool isAnyCut = false;
    for (std::size_t k = 0; k < indices.size(); ++k) {
        const TriangleBounds& bounds = meshes.bounds[indices[k]];
        const auto& [a, b, c] = meshes.meshes->triangles[indices[k]].corners;
        group.front[k] = bounds.front;
        group.back[k] = bounds.back;
        corners.a.set(k, meshes.corners[a] - tile);
        corners.b.set(k, meshes.corners[b] - tile);
        corners.c.set(k, meshes.corners[c] - tile);
        isAnyCut = isAnyCut || isCut(geometry.frame, bounds.front, bounds.back);
    }
    setEdges(corners, group);
    setDepths(corners, group);
    if (!isAnyCut) return group;
    for (std::size_t k = 0; k < indices.size(); ++k)
        if (isCut(geometry.frame, group.front[k], group.back[k]))
            setUpCut(geometry, meshes.meshes->triangles[indices[k]], glm::dvec2(corner), k, group);
    return group;
}

}  // namespace render
