// Boxes are halved at the median of the triangles' middles along their longest axis.
#include "studies/oracle/mesh_tree.h"

#include <algorithm>

namespace oracle {

namespace {

constexpr std::size_t kMostInLeaf = 4;  // chosen

/// The point where a ray meets a triangle. The weights of the corners are the volumes of the tetrahedra between the ray
/// and an edge, up to a common factor; each edge has the same volume, but for its sign, in both of its triangles, so
/// that no ray passes between them.
Hit hitTriangle(const Ray& ray, const MeshTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const auto volume = [&](const dvec3& from, const dvec3& to) {
        return glm::dot(ray.direction, glm::cross(from - ray.origin, to - ray.origin));
    };
    const dvec3 volumes{volume(b, c), volume(c, a), volume(a, b)};
    const double sum = volumes.x + volumes.y + volumes.z;
    const bool isInside = glm::all(glm::greaterThanEqual(volumes, dvec3(0.0)));
    if (sum == 0.0 || !(isInside || glm::all(glm::lessThanEqual(volumes, dvec3(0.0))))) return {};
    const dvec3 weights = volumes / sum;
    const dvec3 point = weights.x * a + weights.y * b + weights.z * c;
    const double distance = glm::dot(point - ray.origin, ray.direction);
    if (!(distance > 0.0)) return {};
    Hit hit = hitAt(ray, distance);
    hit.kind = Hit::Kind::meshObstacle;
    hit.albedo = triangle.color;
    const dvec3 flat = glm::cross(b - a, c - a);
    const dvec3 mean =
        weights.x * triangle.normals[0] + weights.y * triangle.normals[1] + weights.z * triangle.normals[2];
    hit.medium = triangle.medium;
    hit.isInner = glm::dot(flat, ray.direction) > 0.0;
    const double side = hit.isInner ? -1.0 : 1.0;
    hit.normal = side * unitOr(mean, unitOr(flat, -ray.direction));
    return hit;
}

/// Whether a ray runs against the outer side of a triangle.
bool isOuter(const Ray& ray, const MeshTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    return glm::dot(glm::cross(b - a, c - a), ray.direction) < 0.0;
}

}  // namespace

MeshTree::MeshTree(const render::View& view) {
    for (const render::MeshObstacle& obstacle : view.meshObstacles) {
        const render::SolidMesh& mesh = *obstacle.mesh;
        for (const std::array<std::uint32_t, 3>& corners : mesh.triangles) {
            MeshTriangle triangle{{}, {}, dvec3(obstacle.color), obstacle.medium};
            for (std::size_t k = 0; k < 3; ++k) {
                triangle.corners[k] =
                    glm::dmat3(obstacle.rotation) * dvec3(mesh.positions[corners[k]]) + dvec3(obstacle.position);
                triangle.normals[k] = glm::dmat3(obstacle.rotation) * dvec3(mesh.normals[corners[k]]);
            }
            triangles_.push_back(triangle);
        }
    }
    nodes_.push_back({});
    nodes_[0].count = triangles_.size();
    split(0);
}

void MeshTree::split(std::size_t node) {
    const std::size_t first = nodes_[node].first;
    const std::size_t count = nodes_[node].count;
    for (std::size_t k = first; k < first + count; ++k) {
        for (const dvec3& corner : triangles_[k].corners) {
            nodes_[node].low = glm::min(nodes_[node].low, corner);
            nodes_[node].high = glm::max(nodes_[node].high, corner);
        }
    }
    // A little larger, so that no ray that meets a triangle misses the box by rounding.
    const dvec3 slack = 1e-12 * (glm::abs(nodes_[node].low) + glm::abs(nodes_[node].high));
    nodes_[node].low -= slack;
    nodes_[node].high += slack;
    if (count <= kMostInLeaf) return;
    const dvec3 size = nodes_[node].high - nodes_[node].low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = [&](const MeshTriangle& t) {
        return t.corners[0][axis] + t.corners[1][axis] + t.corners[2][axis];
    };
    const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2), begin + static_cast<std::ptrdiff_t>(count),
                     [&](const MeshTriangle& a, const MeshTriangle& b) { return middle(a) < middle(b); });
    const std::size_t children = nodes_.size();
    nodes_[node].children = children;
    nodes_.resize(children + 2);
    nodes_[children].first = first;
    nodes_[children].count = count / 2;
    nodes_[children + 1].first = first + count / 2;
    nodes_[children + 1].count = count - count / 2;
    split(children);
    split(children + 1);
}

void MeshTree::trace(std::size_t node, const Ray& ray, bool outerOnly, Hit& best) const {
    const Node& at = nodes_[node];
    const BoxInterval inside = boxInterval(ray, at.low, at.high);
    if (inside.enter > inside.exit || inside.exit < 0.0 || inside.enter > best.distance) return;
    if (at.children != 0) {
        trace(at.children, ray, outerOnly, best);
        trace(at.children + 1, ray, outerOnly, best);
        return;
    }
    for (std::size_t k = at.first; k < at.first + at.count; ++k) {
        if (outerOnly && (triangles_[k].medium.isTransparent() || !isOuter(ray, triangles_[k]))) continue;
        const Hit hit = hitTriangle(ray, triangles_[k]);
        if (hit.distance < best.distance) best = hit;
    }
}

Hit MeshTree::nearest(const Ray& ray) const {
    Hit best;
    if (!triangles_.empty()) trace(0, ray, false, best);
    return best;
}

bool MeshTree::isEntered(const Ray& ray) const {
    Hit best;
    if (!triangles_.empty()) trace(0, ray, true, best);
    return best.distance < kInfinity;
}

}  // namespace oracle
