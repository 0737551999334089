// The volume by the divergence theorem.
#include "render/mesh/triangle_mesh.h"

namespace render {

double volumeOf(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) return 0.0;
    // Relative to a vertex, so that no digits are lost far away from the origin.
    const glm::dvec3 origin = mesh.positions.front();
    double sixfold = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        sixfold += dot(mesh.positions[a] - origin, cross(mesh.positions[b] - origin, mesh.positions[c] - origin));
    return sixfold / 6.0;
}

}  // namespace render
