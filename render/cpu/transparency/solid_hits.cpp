// The hierarchy is walked with a stack, nearer boxes first. Among hits at equal distances that with the least id
// counts, so that the result does not depend on the order of the walk.
#include "render/cpu/transparency/solid_hits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace render {

namespace {

/// A ray and what it has met so far.
class SolidSearch {
 public:
    SolidSearch(const SolidTree& tree, const ShadingGeometry& geometry, glm::vec3 origin, glm::vec3 direction,
                float least, float most)
        : tree_(tree), geometry_(geometry), origin_(origin), direction_(direction), least_(least) {
        best_.distance = most;
        const glm::vec3 tiny(std::numeric_limits<float>::min());
        inverse_ = 1.0F / mix(max(direction, tiny), min(direction, -tiny), lessThan(direction, glm::vec3(0.0F)));
    }

    SolidHit find() {
        if (geometry_.ground) keep((*geometry_.ground - origin_.y) * inverse_.y, kHitGround);
        if (!tree_.nodes.empty()) walk();
        return best_;
    }

 private:
    /// A node that the ray enters at a distance.
    struct Entry {
        std::uint32_t node;
        float distance;
    };

    void walk() {
        std::array<Entry, kDeepestTree + 1> stack;
        std::size_t height = 0;
        stack[height++] = entryOf(0);
        while (height > 0) {
            const Entry entry = stack[--height];
            if (!(entry.distance <= best_.distance) || entry.distance == kMissed) continue;
            const TreeNode& node = tree_.nodes[entry.node];
            if (node.count > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k) meet(tree_.solids[k]);
                continue;
            }
            Entry near = entryOf(node.first);
            Entry far = entryOf(node.first + 1);
            if (far.distance < near.distance) std::swap(near, far);
            if (far.distance != kMissed) stack[height++] = far;
            if (near.distance != kMissed) stack[height++] = near;
        }
    }

    static constexpr float kMissed = std::numeric_limits<float>::infinity();

    /// Where the ray enters a node's box, kMissed if it misses the box.
    Entry entryOf(std::uint32_t index) const {
        const TreeNode& node = tree_.nodes[index];
        const glm::vec3 a = (node.low - origin_) * inverse_;
        const glm::vec3 b = (node.high - origin_) * inverse_;
        const glm::vec3 first = min(a, b);
        const glm::vec3 last = max(a, b);
        const float enter = std::max({first.x, first.y, first.z, 0.0F});
        // A little more than rounding can take from the interval of a flat box.
        const float leave = std::min({last.x, last.y, last.z}) * 1.00001F;
        return {index, enter <= leave ? enter : kMissed};
    }

    void meet(std::int32_t id) {
        if (id >= kHitBox) return meetBox(id);
        if (id >= kHitTriangle) return meetTriangle(id);
        const ViewSphere& sphere = geometry_.spheres[static_cast<std::size_t>(id)];
        const glm::vec3 toCenter = sphere.center - origin_;
        const float closest = dot(toCenter, direction_);
        const glm::vec3 off = toCenter - closest * direction_;
        const float inside = sphere.radius * sphere.radius - dot(off, off);
        if (inside > 0.0F) keep(closest - std::sqrt(inside), id);
    }

    /// A box is met where the ray enters it.
    void meetBox(std::int32_t id) {
        const BoxObstacle& box = geometry_.boxes[static_cast<std::size_t>(id - kHitBox) / 16];
        const glm::vec3 a = (box.minimum - geometry_.frame.eye - origin_) * inverse_;
        const glm::vec3 b = (box.maximum - geometry_.frame.eye - origin_) * inverse_;
        const glm::vec3 first = min(a, b);
        const glm::vec3 last = max(a, b);
        const int axis = first.x >= first.y && first.x >= first.z ? 0 : first.y >= first.z ? 1 : 2;
        if (first[axis] > std::min({last.x, last.y, last.z})) return;
        keep(first[axis], id + 2 * axis + (direction_[axis] > 0.0F ? 1 : 0));
    }

    /// Moeller and Trumbore 1997.
    void meetTriangle(std::int32_t id) {
        const DrawnMeshes& meshes = *geometry_.meshes;
        const auto& corners = meshes.triangles[static_cast<std::size_t>(id - kHitTriangle)].corners;
        const glm::vec3 corner = meshes.positions[corners[0]];
        const glm::vec3 toSecond = meshes.positions[corners[1]] - corner;
        const glm::vec3 toThird = meshes.positions[corners[2]] - corner;
        const glm::vec3 across = cross(direction_, toThird);
        const float determinant = dot(toSecond, across);
        if (determinant == 0.0F) return;
        const glm::vec3 off = origin_ - corner;
        const float second = dot(off, across) / determinant;
        const glm::vec3 aside = cross(off, toSecond);
        const float third = dot(direction_, aside) / determinant;
        // Rays that run through an edge are met by one of the triangles at least.
        constexpr float kSlack = 1e-6F;
        if (second < -kSlack || third < -kSlack || second + third > 1.0F + kSlack) return;
        keep(dot(toThird, aside) / determinant, id);
    }

    void keep(float distance, std::int32_t id) {
        if (!(distance > least_ && distance <= best_.distance)) return;
        if (distance == best_.distance && id > best_.hitId) return;
        best_ = {distance, id};
    }

    const SolidTree& tree_;
    const ShadingGeometry& geometry_;
    glm::vec3 origin_, direction_;
    glm::vec3 inverse_{1.0F};
    float least_;
    SolidHit best_;
};

SolidSurface triangleSurface(const DrawnMeshes& meshes, std::size_t index, glm::vec3 point, glm::vec3 direction) {
    const DrawnTriangle& triangle = meshes.triangles[index];
    const glm::vec3 corner = meshes.positions[triangle.corners[0]];
    const glm::vec3 toSecond = meshes.positions[triangle.corners[1]] - corner;
    const glm::vec3 toThird = meshes.positions[triangle.corners[2]] - corner;
    const glm::vec3 flat = cross(toSecond, toThird);
    const float inverse = 1.0F / std::max(dot(flat, flat), std::numeric_limits<float>::min());
    const glm::vec3 off = point - corner;
    const float second = std::clamp(dot(cross(off, toThird), flat) * inverse, 0.0F, 1.0F);
    const float third = std::clamp(dot(cross(toSecond, off), flat) * inverse, 0.0F, 1.0F);
    const glm::vec3 mean = meshes.normals[triangle.corners[0]] * (1.0F - second - third) +
                           meshes.normals[triangle.corners[1]] * second + meshes.normals[triangle.corners[2]] * third;
    SolidSurface surface;
    surface.isInner = dot(flat, direction) > 0.0F;
    const float side = surface.isInner ? -1.0F : 1.0F;
    // Interpolated normals that the ray sees from behind, or that cancel each other, are no direction to refract by.
    const bool isSmooth = dot(mean, mean) > 1e-12F && side * dot(mean, direction) < 0.0F;
    surface.normal = side * normalize(isSmooth ? mean : flat);
    surface.color = meshes.colors[triangle.mesh];
    return surface;
}

glm::vec3 unpackedColor(std::uint32_t bits) {
    const glm::vec3 root(static_cast<float>(bits & 2047U) / 2047.0F, static_cast<float>(bits >> 11U & 2047U) / 2047.0F,
                         static_cast<float>(bits >> 22U) / 1023.0F);
    return root * root;
}

}  // namespace

SolidHit nearestSolid(const SolidTree& tree, const ShadingGeometry& geometry, glm::vec3 origin, glm::vec3 direction,
                      float least, float most) {
    return SolidSearch(tree, geometry, origin, direction, least, most).find();
}

SolidSurface surfaceAt(const ShadingGeometry& geometry, glm::vec3 origin, glm::vec3 direction, const SolidHit& hit) {
    const glm::vec3 point = origin + hit.distance * direction;
    if (hit.hitId == kHitGround) return {{0.0F, 1.0F, 0.0F}, geometry.groundColor, false};
    if (hit.hitId >= kHitBox) {
        const std::int32_t face = (hit.hitId - kHitBox) & 7;
        glm::vec3 normal(0.0F);
        normal[face / 2] = (face & 1) == 0 ? 1.0F : -1.0F;
        return {normal, geometry.boxes[static_cast<std::size_t>(hit.hitId - kHitBox) / 16].color, false};
    }
    if (hit.hitId >= kHitTriangle)
        return triangleSurface(*geometry.meshes, static_cast<std::size_t>(hit.hitId - kHitTriangle), point, direction);
    const auto index = static_cast<std::size_t>(hit.hitId);
    return {normalize(point - geometry.spheres[index].center), unpackedColor(geometry.attributes[index].color), false};
}

}  // namespace render
