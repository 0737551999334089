// A triangle mesh as plain data: what `globular mesh` makes of metaballs and writes to files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// Three vertices, counterclockwise as seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles over vertices that they share. Each vector of the vertices has one entry per vertex.
struct TriangleMesh {
    std::vector<glm::dvec3> positions;  ///< m
    std::vector<glm::vec3> normals;     ///< unit vectors, outward
    std::vector<glm::vec3> colors;      ///< linear RGB
    std::vector<glm::vec3> velocities;  ///< m/s
    std::vector<Triangle> triangles;
};

/// The volume inside a closed mesh, m^3: positive where its triangles face outward.
double volumeOf(const TriangleMesh& mesh);

}  // namespace render
