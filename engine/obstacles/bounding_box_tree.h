// A tree of bounding boxes (bounding volume hierarchy): finds those of many boxes that are near a point without a look
// at the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/bounding_box.h"

namespace engine {

/// The nodes of a binary tree in depth-first order. A leaf stands for one of the boxes that the tree was built of, the
/// bounds of an inner node contain those of the nodes below it.
class BoundingBoxTree {
 public:
    BoundingBoxTree() = default;

    /// @param boxes  bounded; visitNear() names them by their indices
    explicit BoundingBoxTree(const std::vector<BoundingBox>& boxes);

    bool isEmpty() const { return nodes_.empty(); }

    /// Calls visit(index) for every box that is nearer to a point than `reach` (m), and perhaps for some that are
    /// insignificantly further away. Always in the same order of indices, which is not that of the boxes.
    template <class Visit>
    void visitNear(const Vec3& point, double reach, const Visit& visit) const {
        for (std::size_t k = 0; k < nodes_.size();) {
            const Node& node = nodes_[k];
            if (!node.bounds.isNear(point, reach)) {
                k = node.next;
                continue;
            }
            if (node.box != kInner) visit(node.box);
            ++k;
        }
    }

 private:
    static constexpr std::uint32_t kInner = 0xffffffff;

    struct Node {
        BoundingBox bounds;
        std::uint32_t next = 0;      ///< index of the node that follows this one and all nodes below it
        std::uint32_t box = kInner;  ///< index of the box of a leaf
    };

    void addNodes(const std::vector<BoundingBox>& boxes, std::vector<std::uint32_t>::iterator begin,
                  std::vector<std::uint32_t>::iterator end);

    std::vector<Node> nodes_;
};

}  // namespace engine
