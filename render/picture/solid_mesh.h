// Triangle meshes that are drawn as obstacles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/shading_model.h"

namespace render {

/// The closed surface of a solid, in coordinates of its own.
struct SolidMesh {
    std::vector<glm::vec3> positions;  ///< m
    std::vector<glm::vec3> normals;    ///< outward unit vectors, one for each position; interpolated over a triangle
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of positions, counterclockwise as seen from outside
};

/// A solid mesh at its place in a picture. Its frames share the mesh and differ in the placement.
struct MeshObstacle {
    std::shared_ptr<const SolidMesh> mesh;
    glm::mat3 rotation{1.0F};  ///< from the mesh's coordinates to the picture's
    glm::vec3 position{0.0F};  ///< of the origin of the mesh's coordinates, m
    glm::vec3 color{0.5F};     ///< linear RGB
    Medium medium{};

    /// Whether both have the same mesh, not merely an equal one, at the same place.
    bool operator==(const MeshObstacle&) const = default;
};

}  // namespace render
