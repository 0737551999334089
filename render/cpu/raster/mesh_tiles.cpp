// A triangle that has corners on both sides of the eye's plane is clipped at the edges of the picture to find its
// bounds. It is not cut for anything else, because mesh_hits.cpp handles such triangles as they are.
#include "render/cpu/raster/mesh_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "render/picture/parallel_loops.h"

namespace render {

namespace {

using glm::dvec3;

// How far beside a pixel a triangle may lie and still count as covering it, pixels: far more than the rounding.
constexpr float kSlack = 0.01F;

/// @param point  in world axes, relative to the eye
dvec3 toView(const CameraFrame& frame, glm::vec3 point) {
    const dvec3 at(point);
    return {dot(at, dvec3(frame.right)), dot(at, dvec3(frame.up)), dot(at, dvec3(frame.forward))};
}

/// @param view  in view coordinates
dvec3 onPicture(const CameraFrame& frame, const dvec3& view) {
    const double w = frame.perspective ? view.z : 1.0;
    const glm::dvec2 middle = w * glm::dvec2(frame.middle);
    return {0.5 * frame.width * ((view.x - middle.x) / double(frame.halfWidth) + w),
            0.5 * frame.height * (w - (view.y - middle.y) / double(frame.halfHeight)), w};
}

/// A convex polygon in homogeneous coordinates: a triangle, and what is left of it after four cuts.
struct Polygon {
    std::array<dvec3, 7> points;
    std::size_t count = 3;
};

/// Cuts off the part of a polygon where dot(plane, point) < 0.
Polygon clipped(const Polygon& polygon, const dvec3& plane) {
    Polygon left;
    left.count = 0;
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const dvec3& from = polygon.points[k];
        const dvec3& to = polygon.points[(k + 1) % polygon.count];
        const double atFrom = dot(plane, from);
        const double atTo = dot(plane, to);
        if (atFrom >= 0.0) left.points[left.count++] = from;
        if ((atFrom >= 0.0) != (atTo >= 0.0)) left.points[left.count++] = from + atFrom / (atFrom - atTo) * (to - from);
    }
    return left;
}

/// The part of a triangle that lies within the pyramid of a picture, which is a pixel wider on each side.
Polygon withinPicture(const CameraFrame& frame, const std::array<dvec3, 3>& corners) {
    Polygon polygon{{corners[0], corners[1], corners[2]}};
    for (const dvec3& plane : {dvec3(1.0, 0.0, 1.0), dvec3(-1.0, 0.0, 1.0 + frame.width), dvec3(0.0, 1.0, 1.0),
                               dvec3(0.0, -1.0, 1.0 + frame.height)})
        polygon = clipped(polygon, plane);
    return polygon;
}

/// The part of a rectangle of pixels that lies in the picture.
Rect clippedRect(const CameraFrame& frame, glm::vec2 low, glm::vec2 high) {
    const auto columns = static_cast<float>(frame.width);
    const auto rows = static_cast<float>(frame.height);
    if (!(low.x < columns && low.y < rows && high.x >= 0.0F && high.y >= 0.0F)) return {};
    return {static_cast<int>(std::max(low.x, 0.0F)), static_cast<int>(std::max(low.y, 0.0F)),
            static_cast<int>(std::min(high.x, columns - 1.0F)), static_cast<int>(std::min(high.y, rows - 1.0F))};
}

/// The pixels that a polygon before the eye may cover.
Rect pixelsOf(const CameraFrame& frame, const Polygon& polygon) {
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (std::size_t k = 0; k < polygon.count; ++k) {
        const dvec3& point = polygon.points[k];
        if (!(point.z > 0.0)) return {0, 0, frame.width - 1, frame.height - 1};  // the eye lies on the triangle
        low = min(low, glm::dvec2(point) / point.z);
        high = max(high, glm::dvec2(point) / point.z);
    }
    return clippedRect(frame, glm::vec2(floor(low - double(kSlack))), glm::vec2(floor(high + double(kSlack))));
}

/// Whether a triangle is seen from the side that its corners run around counterclockwise. The rows of a picture run
/// down and its depth away from the eye, so that the picture's axes have the handedness of the world's.
/// @param volume  twice its signed area on the picture, or the determinant of its corners in homogeneous
/// coordinates, which has the same sign
bool isFront(double volume) {
    return volume < 0.0;
}

/// The pixels that a triangle before the eye may cover; none for one that is turned away from the eye and culled.
Rect pixelsBeforeEye(const CameraFrame& frame, const std::array<glm::vec3, 3>& corners, bool isCulled) {
    const glm::vec2 a(corners[0]);
    const glm::vec2 b(corners[1]);
    const glm::vec2 c(corners[2]);
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0F || (isCulled && !isFront(area))) return {};
    const glm::vec2 low = floor(min(a, min(b, c)) - kSlack);
    const glm::vec2 high = floor(max(a, max(b, c)) + kSlack);
    return clippedRect(frame, low, high);
}

/// The pixels that a triangle with corners on both sides of the eye's plane may cover.
Rect pixelsOfCut(const CameraFrame& frame, const std::array<dvec3, 3>& corners, bool isCulled) {
    const double volume = dot(corners[0], cross(corners[1], corners[2]));
    if (volume == 0.0 || (isCulled && !isFront(volume))) return {};
    const Polygon polygon = withinPicture(frame, corners);
    return polygon.count == 0 ? Rect{} : pixelsOf(frame, polygon);
}

TriangleBounds boundsOf(const CameraFrame& frame, const MeshTiles& to, const DrawnTriangle& triangle, bool isCulled) {
    const auto& [a, b, c] = triangle.corners;
    TriangleBounds bounds;
    bounds.front = std::min({to.depths[a], to.depths[b], to.depths[c]});
    bounds.back = std::max({to.depths[a], to.depths[b], to.depths[c]});
    if (!(bounds.back > 0.0F)) return bounds;
    if (isCut(frame, bounds.front, bounds.back)) {
        const std::vector<glm::vec3>& positions = to.meshes->positions;
        bounds.pixels =
            pixelsOfCut(frame,
                        {homogeneousOnPicture(frame, positions[a]), homogeneousOnPicture(frame, positions[b]),
                         homogeneousOnPicture(frame, positions[c])},
                        isCulled);
    } else {
        bounds.pixels = pixelsBeforeEye(frame, {to.corners[a], to.corners[b], to.corners[c]}, isCulled);
    }
    return bounds;
}

/// A triangle that the picture may show.
struct SeenTriangle {
    std::uint32_t index;
    float front;  // least view depth of a corner, m
};

CellLists listTriangles(const CameraFrame& frame, const std::vector<TriangleBounds>& bounds, int margin) {
    const auto seen = listAll<SeenTriangle>(bounds.size(), [&](std::size_t k, std::vector<SeenTriangle>& list) {
        if (bounds[k].pixels.x0 <= bounds[k].pixels.x1)
            list.push_back({static_cast<std::uint32_t>(k), bounds[k].front});
    });
    std::vector<float> fronts;
    fronts.reserve(seen.size());
    for (const SeenTriangle& triangle : seen) fronts.push_back(triangle.front);
    const std::vector<std::uint32_t> order = indicesByKey(fronts);
    const auto tileOf = [](int pixel, int count) { return std::clamp(pixel, 0, count - 1) / kTileSize; };
    std::vector<CellItem> items(seen.size());
    forAll(items.size(), [&](std::size_t k) {
        const std::uint32_t index = seen[order[k]].index;
        const Rect& at = bounds[index].pixels;
        items[k] = {index,
                    {tileOf(at.x0 - margin, frame.width), tileOf(at.y0 - margin, frame.height),
                     tileOf(at.x1 + margin, frame.width), tileOf(at.y1 + margin, frame.height)}};
    });
    return binIntoCells(items, tilesAlong(frame.width), tilesAlong(frame.height));
}

}  // namespace

glm::dvec3 homogeneousOnPicture(const CameraFrame& frame, glm::vec3 point) {
    return onPicture(frame, toView(frame, point));
}

MeshTiles meshTiles(const CameraFrame& frame, const DrawnMeshes& meshes, int margin, MeshTiles old) {
    MeshTiles to = std::move(old);
    to.meshes = meshes.empty() ? nullptr : &meshes;
    to.corners.resize(meshes.positions.size());
    to.depths.resize(meshes.positions.size());
    to.bounds.resize(meshes.triangles.size());
    if (meshes.empty()) return to;
    forAll(meshes.positions.size(), [&](std::size_t k) {
        const dvec3 view = toView(frame, meshes.positions[k]);
        const dvec3 at = onPicture(frame, view);
        to.corners[k] = glm::vec3(at.x / at.z, at.y / at.z, frame.perspective ? 1.0 / at.z : view.z);
        to.depths[k] = static_cast<float>(view.z);
    });
    std::vector<char> isCulled;
    for (const Bounds<glm::vec3>& box : meshes.bounds) isCulled.push_back(isOutside(frame, box) ? 1 : 0);
    forAll(meshes.triangles.size(), [&](std::size_t k) {
        const DrawnTriangle& triangle = meshes.triangles[k];
        to.bounds[k] = boundsOf(frame, to, triangle, isCulled[triangle.mesh] != 0);
    });
    to.tiles = listTriangles(frame, to.bounds, margin);
    return to;
}

}  // namespace render
