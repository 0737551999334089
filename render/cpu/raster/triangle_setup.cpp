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

/// Sets the functions of a triangle of which a part lies behind the eye.
void setUpCut(const SolidGeometry& geometry, const DrawnTriangle& triangle, glm::dvec2 corner, TriangleSetup& setup) {
    using glm::dvec3;
    std::array<dvec3, 3> points;
    for (std::size_t k = 0; k < 3; ++k)
        points[k] = homogeneousOnPicture(geometry.frame, geometry.meshes->meshes->positions[triangle.corners[k]]);
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
    for (std::size_t k = 0; k < 3; ++k) setup.edges[k] = glm::vec3(scale * atCorner(planes[k]));
    setup.depth = glm::vec3(atCorner(planes[0] + planes[1] + planes[2]) / volume);
}

/// Sets the functions of a triangle before the eye from its corners on the picture.
/// @param corners  as in MeshTiles, but from the tile's corner
void setUpWhole(const std::array<glm::vec3, 3>& corners, TriangleSetup& setup) {
    const auto& [a, b, c] = corners;
    const glm::vec3 toB = b - a;
    const glm::vec3 toC = c - a;
    const float area = toB.x * toC.y - toB.y * toC.x;
    const float side = area < 0.0F ? -1.0F : 1.0F;
    const auto edge = [&](const glm::vec3& from, const glm::vec3& to) {
        return side * glm::vec3(from.y - to.y, to.x - from.x, from.x * to.y - to.x * from.y);
    };
    setup.edges = {edge(b, c), edge(c, a), edge(a, b)};
    // In double precision, because far from its nearest corner 1 / view depth is a small difference.
    const glm::dvec3 first(toB);
    const glm::dvec3 second(toC);
    const double inverse = 1.0 / (first.x * second.y - first.y * second.x);
    const double across = (first.z * second.y - second.z * first.y) * inverse;
    const double down = (second.z * first.x - first.z * second.x) * inverse;
    setup.depth = glm::vec3(across, down, double(a.z) - across * double(a.x) - down * double(a.y));
}

}  // namespace

TriangleSetup triangleSetup(const SolidGeometry& geometry, std::uint32_t index, glm::vec2 corner) {
    const MeshTiles& meshes = *geometry.meshes;
    const DrawnTriangle& triangle = meshes.meshes->triangles[index];
    TriangleSetup setup;
    setup.front = meshes.bounds[index].front;
    setup.back = meshes.bounds[index].back;
    if (isCut(geometry.frame, setup.front, setup.back)) {
        setUpCut(geometry, triangle, glm::dvec2(corner), setup);
        return setup;
    }
    const auto fromTile = [&](std::size_t k) { return meshes.corners[triangle.corners[k]] - glm::vec3(corner, 0.0F); };
    setUpWhole({fromTile(0), fromTile(1), fromTile(2)}, setup);
    return setup;
}

}  // namespace render
