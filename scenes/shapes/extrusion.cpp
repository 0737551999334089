#include "scenes/shapes/extrusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scenes {
namespace {

/// Edges whose box is looked at before they are. Chosen: outlines of images have thousands.
constexpr std::size_t kBlockSize = 16;

double squared(double x) {
    return x * x;
}

}  // namespace

Extrusion::Extrusion(const Outline& outline, double depth)
    : isByWinding_(outline.isByWinding), halfDepth_(0.5 * depth) {
    for (const auto& [start, end] : outline.edges) {
        if (start == end) continue;
        if (edges_.size() % kBlockSize == 0) blocks_.push_back({start, start});
        edges_.push_back({start, end});
        Block& block = blocks_.back();
        for (const OutlinePoint& point : {start, end})
            for (std::size_t axis = 0; axis < 2; ++axis) {
                block.low[axis] = std::min(block.low[axis], point[axis]);
                block.high[axis] = std::max(block.high[axis], point[axis]);
            }
    }
}

double Extrusion::outlineDistance(double x, double y) const {
    double leastSq = std::numeric_limits<double>::infinity();
    int windings = 0;
    int crossings = 0;
    for (std::size_t block = 0; block < blocks_.size(); ++block) {
        const Block& box = blocks_[block];
        const double boxSq = squared(std::max({box.low[0] - x, x - box.high[0], 0.0})) +
                             squared(std::max({box.low[1] - y, y - box.high[1], 0.0}));
        const bool isCrossed = y >= box.low[1] && y < box.high[1] && x < box.high[0];
        if (boxSq >= leastSq && !isCrossed) continue;
        const std::size_t end = std::min((block + 1) * kBlockSize, edges_.size());
        for (std::size_t k = block * kBlockSize; k < end; ++k) {
            const OutlinePoint& a = edges_[k].start;
            const OutlinePoint& b = edges_[k].end;
            const double dx = b[0] - a[0];
            const double dy = b[1] - a[1];
            const double share = ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy);
            const double clamped = std::min(std::max(share, 0.0), 1.0);
            leastSq = std::min(leastSq, squared(x - a[0] - clamped * dx) + squared(y - a[1] - clamped * dy));
            // Whether a ray to the right crosses the edge, counted as going up or down.
            if ((a[1] <= y) == (b[1] <= y)) continue;
            const double side = dx * (y - a[1]) - dy * (x - a[0]);
            if ((side > 0.0) != (dy > 0.0)) continue;
            ++crossings;
            windings += dy > 0.0 ? 1 : -1;
        }
    }
    const bool isInside = isByWinding_ ? windings != 0 : crossings % 2 == 1;
    return isInside ? -std::sqrt(leastSq) : std::sqrt(leastSq);
}

double Extrusion::distance(const engine::Vec3& point) const {
    const double across = outlineDistance(point.x(), point.y());
    const double along = std::abs(point.z()) - halfDepth_;
    return std::min(std::max(across, along), 0.0) +
           std::sqrt(squared(std::max(across, 0.0)) + squared(std::max(along, 0.0)));
}

engine::BoundingBox Extrusion::bounds() const {
    engine::BoundingBox box = engine::BoundingBox::empty();
    for (const Block& block : blocks_)
        box.include({{block.low[0], block.low[1], -halfDepth_}, {block.high[0], block.high[1], halfDepth_}});
    return box;
}

}  // namespace scenes
