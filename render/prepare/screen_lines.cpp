// Edges are projected and clipped in double precision: one that passes close to the eye is very long on the picture.
#include "render/prepare/screen_lines.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace render {

namespace {

// Least view depth of a line, as a share of the depth of its farther end. Chosen: at the eye itself a line has no
// direction on the picture.
constexpr double kNearDepth = 1e-6;

struct ScreenPoint {
    double x;      // position on the picture, pixels
    double y;      // position on the picture, pixels
    double depth;  // view depth, m
};

ScreenPoint project(const CameraFrame& frame, glm::dvec3 view) {
    const double scale = frame.perspective ? 1.0 / view.z : 1.0;
    const glm::dvec2 middle(frame.middle);
    return {0.5 * frame.width * (1.0 + (view.x * scale - middle.x) / frame.halfWidth),
            0.5 * frame.height * (1.0 - (view.y * scale - middle.y) / frame.halfHeight), view.z};
}

/// Clips the segment from a to b to view depths above zero. @return false if nothing is left
bool clipNear(glm::dvec3& a, glm::dvec3& b) {
    const double least = kNearDepth * std::max(a.z, b.z);
    if (least <= 0.0) return false;
    if (a.z < least) a += (b - a) * ((least - a.z) / (b.z - a.z));
    if (b.z < least) b += (a - b) * ((least - b.z) / (a.z - b.z));
    return true;
}

/// Liang-Barsky clipping along one axis: narrows the range of parameters t to where from + t step lies in [low, high].
/// @return false if nothing is left
bool clipAxis(double from, double step, double low, double high, std::pair<double, double>& range) {
    if (step == 0.0) return from >= low && from <= high;
    const double first = (low - from) / step;
    const double second = (high - from) / step;
    range.first = std::max(range.first, std::min(first, second));
    range.second = std::min(range.second, std::max(first, second));
    return range.first <= range.second;
}

/// The point at parameter t of a projected segment.
ScreenPoint pointAt(const CameraFrame& frame, const ScreenPoint& a, const ScreenPoint& b, double t) {
    const double depth =
        frame.perspective ? 1.0 / ((1.0 - t) / a.depth + t / b.depth) : a.depth + (b.depth - a.depth) * t;
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, depth};
}

std::optional<ScreenLine> screenLine(const CameraFrame& frame, const Edge& edge) {
    glm::dvec3 from(frame.toView(edge.from));
    glm::dvec3 to(frame.toView(edge.to));
    if (!clipNear(from, to)) return std::nullopt;
    const ScreenPoint a = project(frame, from);
    const ScreenPoint b = project(frame, to);
    const double margin = edge.width + 2.0;
    std::pair<double, double> range{0.0, 1.0};
    if (!clipAxis(a.x, b.x - a.x, -margin, frame.width + margin, range)) return std::nullopt;
    if (!clipAxis(a.y, b.y - a.y, -margin, frame.height + margin, range)) return std::nullopt;
    const ScreenPoint c = pointAt(frame, a, b, range.first);
    const ScreenPoint d = pointAt(frame, a, b, range.second);
    return ScreenLine{{c.x, c.y}, {d.x, d.y}, static_cast<float>(c.depth), static_cast<float>(d.depth),
                      edge.width, edge.color};
}

/// How far from a line its pixels may be, in pixels: half its width and what the antialiasing adds.
float reachOf(const ScreenLine& line) {
    return 0.5F * line.width + 1.5F;
}

/// Whether a line may touch a tile: compares the distance of the tile's center from the line with half the tile's
/// diagonal.
bool touches(const ScreenLine& line, int column, int row) {
    const glm::vec2 center = (glm::vec2(column, row) + 0.5F) * static_cast<float>(kTileSize);
    const glm::vec2 closest = line.from + closestParameter(line, center) * (line.to - line.from);
    return distance(center, closest) <= 0.7072F * static_cast<float>(kTileSize) + reachOf(line);
}

void addTouchedTiles(const ScreenLine& line, std::uint32_t index, const CameraFrame& frame,
                     std::vector<CellItem>& items) {
    const float reach = reachOf(line);
    // Conversion rounds toward zero, and negative values are clamped to zero.
    const auto tileOf = [](float at, int count) {
        return std::clamp(static_cast<int>(at / static_cast<float>(kTileSize)), 0, (count - 1) / kTileSize);
    };
    const int x0 = tileOf(std::min(line.from.x, line.to.x) - reach, frame.width);
    const int x1 = tileOf(std::max(line.from.x, line.to.x) + reach, frame.width);
    const int y0 = tileOf(std::min(line.from.y, line.to.y) - reach, frame.height);
    const int y1 = tileOf(std::max(line.from.y, line.to.y) + reach, frame.height);
    for (int row = y0; row <= y1; ++row) {
        for (int column = x0; column <= x1; ++column) {
            if (touches(line, column, row)) items.push_back({index, {column, row, column, row}});
        }
    }
}

}  // namespace

float closestParameter(const ScreenLine& line, glm::vec2 pixel) {
    const glm::vec2 along = line.to - line.from;
    return std::clamp(dot(pixel - line.from, along) / std::max(dot(along, along), 1.0e-12F), 0.0F, 1.0F);
}

LineList projectEdges(const CameraFrame& frame, std::span<const Edge> edges) {
    LineList list;
    std::vector<CellItem> items;
    for (const Edge& edge : edges) {
        const auto line = screenLine(frame, edge);
        if (!line) continue;
        addTouchedTiles(*line, static_cast<std::uint32_t>(list.lines.size()), frame, items);
        list.lines.push_back(*line);
    }
    list.tiles = binIntoCells(items, tilesAlong(frame.width), tilesAlong(frame.height));
    return list;
}

}  // namespace render
