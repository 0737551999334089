// The mesh obstacles of a view at their places in the picture, as both renderers draw them: the corners of all meshes
// in one list. Made by the preparation of a view.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/bounds.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"

namespace render {

/// A triangle of a mesh obstacle.
struct DrawnTriangle {
    std::array<std::uint32_t, 3> corners;  ///< of DrawnMeshes::positions, counterclockwise as seen from outside
    std::uint32_t mesh;                    ///< index of its obstacle in the view
};

/// All mesh obstacles of a view, along the world's axes, relative to the eye.
struct DrawnMeshes {
    std::vector<glm::vec3> positions;  ///< of the corners, m
    std::vector<glm::vec3> normals;    ///< outward unit vectors, one for each position
    std::vector<DrawnTriangle> triangles;
    std::vector<glm::vec3> colors;          ///< one for each mesh
    std::vector<Bounds<glm::vec3>> bounds;  ///< around the corners of each mesh, m
    std::vector<MeshObstacle> obstacles;    ///< of the view
    glm::vec3 eye{0.0F};                    ///< world coordinates, m

    bool empty() const { return triangles.empty(); }
    /// Whether light does not pass a triangle's mesh.
    bool isOpaque(std::size_t triangle) const { return !obstacles[triangles[triangle].mesh].medium.isTransparent(); }
};

/// Largest number of triangles in one picture.
inline constexpr std::size_t kMostTriangles = std::size_t{1} << 27;

/// Places the meshes of a view.
/// @param eye  world coordinates, m
/// @param old  the meshes of an earlier picture, which are kept if neither they nor the eye have moved; otherwise their
///             memory is reused
/// @throws SystemError  beyond kMostTriangles
DrawnMeshes drawnMeshes(const View& view, glm::vec3 eye, DrawnMeshes old = {});

/// The box around a mesh at its place, world coordinates, m; empty for a mesh without corners.
Bounds<glm::vec3> boundsOf(const MeshObstacle& obstacle);

/// Whether the eye, or in parallel projection its plane, is far enough from a box around a mesh that no ray starts
/// inside of it: then none of the mesh's inner sides is seen.
/// @param box  along the world's axes, relative to the eye, m
bool isOutside(const CameraFrame& frame, const Bounds<glm::vec3>& box);

}  // namespace render
