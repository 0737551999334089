// A bounding volume hierarchy of the spheres, boxes and triangles of a view, for rays that go in any direction. Made by
// the preparation of a view that has transparent bodies.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/drawn_meshes.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"

namespace render {

/// A box around solids. Its children are the nodes `first` and first + 1 or, in a leaf, the solids from `first` on.
struct TreeNode {
    glm::vec3 low{0.0F};      ///< m
    std::uint32_t first = 0;  ///< index of the first child in SolidTree::nodes, or of the first solid
    glm::vec3 high{0.0F};     ///< m
    std::uint32_t count = 0;  ///< number of solids of a leaf; 0 in an inner node
};

/// The hierarchy, whose root is the first node; without nodes if there are no solids. Not all nodes are used. Positions
/// are relative to the eye, along the world's axes.
struct SolidTree {
    std::vector<TreeNode> nodes;
    std::vector<std::int32_t> solids;  ///< what the leaves hold, as hit ids; those of boxes are of face 0
};

/// Greatest depth of a node below the root: rays that walk the tree keep at most one node more on their stack.
inline constexpr int kDeepestTree = 72;

/// The solids of a view.
/// @param spheres  spheres that are drawn as such, relative to the eye
/// @param boxes    in world coordinates
/// @param eye      world coordinates, m
SolidTree solidTree(std::span<const ViewSphere> spheres, std::span<const BoxObstacle> boxes, const DrawnMeshes& meshes,
                    glm::vec3 eye);

}  // namespace render
