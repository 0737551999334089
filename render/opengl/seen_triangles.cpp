// Each triangle is judged by itself, in parallel, and those that are seen are then listed in their order.
#include "render/opengl/seen_triangles.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/glm.hpp>

#include "render/prepare/cells/tiles.h"

namespace render {

namespace {

using glm::dvec3;

constexpr std::size_t kChunk = 2048;  // corners or triangles that one task handles; chosen

// Nothing nearer than this share of the farthest depth is drawn in perspective. Chosen: ten times the rounding of
// positions in single precision.
constexpr float kNearest = 1.0e-6F;

// Pixels beside its corners in which a triangle may be seen: half a pixel for the sampling, the rest for the rounding.
constexpr float kMargin = 1.0F;

/// Calls visit(k) for all k below count, in parallel.
template <typename Visit>
void forEach(std::size_t count, const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kChunk), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k) visit(k);
    });
}

/// The outward normal of a triangle, of any length.
dvec3 normalOf(const DrawnMeshes& meshes, const DrawnTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const dvec3 corner(meshes.positions[a]);
    return cross(dvec3(meshes.positions[b]) - corner, dvec3(meshes.positions[c]) - corner);
}

class Search {
 public:
    Search(const PreparedView& view, SeenTriangles& to)
        : frame_(view.frame), meshes_(view.meshes), columns_(view.sphereTiles.columns), to_(to) {
        corners_.resize(meshes_.positions.size());
        forEach(corners_.size(), [&](std::size_t k) { corners_[k] = onPicture(meshes_.positions[k]); });
        for (const glm::vec3& corner : corners_) to_.farthest = std::max(to_.farthest, corner.z);
        to_.nearest = kNearest * to_.farthest;
        to_.tiles.assign(view.sphereTiles.cellCount(), 0);
        for (const Bounds<glm::vec3>& box : meshes_.bounds) {
            isCulled_.push_back(isOutside(frame_, box) ? 1 : 0);
            wholePixels_.push_back(
                pixelsTouchedByBox(frame_, box.low + frame_.eye, box.high + frame_.eye).value_or(Rect{}));
        }
    }

    void run() {
        std::vector<Rect> pixels(meshes_.triangles.size());
        forEach(pixels.size(), [&](std::size_t k) { pixels[k] = pixelsOf(meshes_.triangles[k]); });
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const Rect& at = pixels[k];
            if (at.x1 < at.x0 || at.y1 < at.y0) continue;
            to_.triangles.push_back(meshes_.triangles[k].corners);
            for (int row = at.y0 / kTileSize; row <= at.y1 / kTileSize; ++row)
                for (int column = at.x0 / kTileSize; column <= at.x1 / kTileSize; ++column)
                    to_.tiles[static_cast<std::size_t>(column + row * columns_)] = 1;
        }
    }

 private:
    /// Where a corner is seen, pixels, and its view depth. The pixels of corners behind the eye have no meaning.
    glm::vec3 onPicture(glm::vec3 position) const {
        const glm::vec3 at = frame_.toView(position + frame_.eye);
        const float w = frame_.perspective ? at.z : 1.0F;
        return {
            0.5F * static_cast<float>(frame_.width) * ((at.x - frame_.middle.x * w) / (frame_.halfWidth * w) + 1.0F),
            0.5F * static_cast<float>(frame_.height) * (1.0F - (at.y - frame_.middle.y * w) / (frame_.halfHeight * w)),
            at.z};
    }

    /// The pixels of the picture in which a triangle may be seen.
    Rect pixelsOf(const DrawnTriangle& triangle) const {
        const auto& [a, b, c] = triangle.corners;
        const auto [front, back] = std::minmax({corners_[a].z, corners_[b].z, corners_[c].z});
        if (!(back > 0.0F)) return {};
        const dvec3 normal = normalOf(meshes_, triangle);
        const dvec3 ray = frame_.perspective ? dvec3(meshes_.positions[a]) : dvec3(frame_.forward);
        const double facing = dot(normal, ray);
        if (facing == 0.0 || (isCulled_[triangle.mesh] != 0 && facing > 0.0)) return {};
        if (frame_.perspective && !(front > to_.nearest)) return withinPicture(wholePixels_[triangle.mesh]);
        const glm::vec2 low = min(min(glm::vec2(corners_[a]), glm::vec2(corners_[b])), glm::vec2(corners_[c]));
        const glm::vec2 high = max(max(glm::vec2(corners_[a]), glm::vec2(corners_[b])), glm::vec2(corners_[c]));
        const glm::vec2 size(frame_.width, frame_.height);
        const glm::vec2 first = max(floor(low - kMargin), glm::vec2(0.0F));
        const glm::vec2 last = min(floor(high + kMargin), size - 1.0F);
        if (!(first.x <= last.x && first.y <= last.y)) return {};
        return {static_cast<int>(first.x), static_cast<int>(first.y), static_cast<int>(last.x),
                static_cast<int>(last.y)};
    }

    Rect withinPicture(const Rect& pixels) const {
        return {std::max(pixels.x0, 0), std::max(pixels.y0, 0), std::min(pixels.x1, frame_.width - 1),
                std::min(pixels.y1, frame_.height - 1)};
    }

    const CameraFrame& frame_;
    const DrawnMeshes& meshes_;
    int columns_;  // of tiles
    SeenTriangles& to_;
    std::vector<glm::vec3> corners_;  // as onPicture() has them
    std::vector<char> isCulled_;      // of each mesh: whether triangles that are turned away are left out
    std::vector<Rect> wholePixels_;   // of each mesh: in which it may be seen
};

}  // namespace

SeenTriangles seenTriangles(const PreparedView& view) {
    SeenTriangles seen;
    Search(view, seen).run();
    return seen;
}

std::vector<TriangleCorners> unlitTriangles(const PreparedView& view) {
    std::vector<TriangleCorners> unlit;
    const dvec3 toLight(view.light.toLight);
    for (std::size_t k = 0; k < view.meshes.triangles.size(); ++k) {
        const DrawnTriangle& triangle = view.meshes.triangles[k];
        if (view.meshes.isOpaque(k) && dot(normalOf(view.meshes, triangle), toLight) < 0.0)
            unlit.push_back(triangle.corners);
    }
    return unlit;
}

}  // namespace render
