// Builds the tree from the top down: the boxes of a node are divided at the median of their middles, along the axis on
// which these are furthest apart.
#include "engine/obstacles/bounding_box_tree.h"

#include <algorithm>
#include <numeric>

namespace engine {

BoundingBoxTree::BoundingBoxTree(const std::vector<BoundingBox>& boxes) {
    if (boxes.empty()) return;
    std::vector<std::uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    nodes_.reserve(2 * boxes.size() - 1);
    addNodes(boxes, order.begin(), order.end());
}

void BoundingBoxTree::addNodes(const std::vector<BoundingBox>& boxes, std::vector<std::uint32_t>::iterator begin,
                               std::vector<std::uint32_t>::iterator end) {
    const std::size_t self = nodes_.size();
    Node node{boxes[*begin]};
    BoundingBox middles{node.bounds.middle(), node.bounds.middle()};
    for (auto box = begin; box != end; ++box) {
        node.bounds.include(boxes[*box]);
        const Vec3 middle = boxes[*box].middle();
        middles.include({middle, middle});
    }
    if (end - begin == 1) node.box = *begin;
    nodes_.push_back(node);
    if (end - begin > 1) {
        int axis = 0;
        (middles.high - middles.low).maxCoeff(&axis);
        const auto half = begin + (end - begin) / 2;
        // Boxes with equal middles are ordered by index, so that every standard library builds the same tree.
        std::ranges::nth_element(begin, half, end, [&](std::uint32_t a, std::uint32_t b) {
            const double first = boxes[a].middle()[axis];
            const double second = boxes[b].middle()[axis];
            return first != second ? first < second : a < b;
        });
        addNodes(boxes, begin, half);
        addNodes(boxes, half, end);
    }
    nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace engine
