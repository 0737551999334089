// Corners are moved in parallel; each depends on itself alone.
#include "render/picture/drawn_meshes.h"

#include <utility>

#include <fmt/format.h>

#include "render/picture/parallel_loops.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

/// Places one mesh, whose corners and triangles begin at these indices.
void place(const MeshObstacle& obstacle, glm::vec3 eye, std::size_t firstCorner, std::size_t firstTriangle,
           DrawnMeshes& meshes) {
    const SolidMesh& mesh = *obstacle.mesh;
    const glm::vec3 offset = obstacle.position - eye;
    forAll(mesh.positions.size(), [&](std::size_t k) {
        meshes.positions[firstCorner + k] = obstacle.rotation * mesh.positions[k] + offset;
        meshes.normals[firstCorner + k] = obstacle.rotation * mesh.normals[k];
    });
    const auto first = static_cast<std::uint32_t>(firstCorner);
    const auto number = static_cast<std::uint32_t>(meshes.colors.size());
    forAll(mesh.triangles.size(), [&](std::size_t k) {
        const auto& [a, b, c] = mesh.triangles[k];
        meshes.triangles[firstTriangle + k] = {{first + a, first + b, first + c}, number};
    });
    meshes.bounds.push_back(
        boundsOfAll(mesh.positions.size(), [&](std::size_t k) { return meshes.positions[firstCorner + k]; }));
    meshes.colors.push_back(obstacle.color);
}

}  // namespace

DrawnMeshes drawnMeshes(const View& view, glm::vec3 eye, DrawnMeshes old) {
    if (old.obstacles == view.meshObstacles && old.eye == eye) return old;
    DrawnMeshes meshes = std::move(old);
    std::size_t corners = 0;
    std::size_t triangles = 0;
    for (const MeshObstacle& obstacle : view.meshObstacles) {
        corners += obstacle.mesh->positions.size();
        triangles += obstacle.mesh->triangles.size();
    }
    if (triangles > kMostTriangles || corners > 3 * kMostTriangles)
        throw SystemError(fmt::format("drawing {} triangles: a picture has at most 2^27", triangles));
    meshes.positions.resize(corners);
    meshes.normals.resize(corners);
    meshes.triangles.resize(triangles);
    meshes.bounds.clear();
    meshes.colors.clear();
    corners = 0;
    triangles = 0;
    for (const MeshObstacle& obstacle : view.meshObstacles) {
        place(obstacle, eye, corners, triangles, meshes);
        corners += obstacle.mesh->positions.size();
        triangles += obstacle.mesh->triangles.size();
    }
    meshes.obstacles = view.meshObstacles;
    meshes.eye = eye;
    return meshes;
}

Bounds<glm::vec3> boundsOf(const MeshObstacle& obstacle) {
    const std::vector<glm::vec3>& positions = obstacle.mesh->positions;
    return boundsOfAll(positions.size(),
                       [&](std::size_t k) { return obstacle.rotation * positions[k] + obstacle.position; });
}

bool isOutside(const CameraFrame& frame, const Bounds<glm::vec3>& box) {
    const glm::vec3 slack = 1.0e-5F * (abs(box.low) + abs(box.high));
    const glm::vec3 low = box.low - slack;
    const glm::vec3 high = box.high + slack;
    if (frame.perspective) return any(greaterThan(low, glm::vec3(0.0F))) || any(lessThan(high, glm::vec3(0.0F)));
    const glm::vec3 nearest = mix(low, high, lessThan(frame.forward, glm::vec3(0.0F)));
    return dot(nearest, frame.forward) > 0.0F;
}

}  // namespace render
