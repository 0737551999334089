// The lines of tessellation.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>

#include "scenes/shapes/tessellation.h"

namespace scenes {
namespace {

using engine::Vec3;

constexpr double kSharp = 0.866;  // cosine of 30 degrees

/// Lines that a circle is divided into. Chosen: chords are off the circle by a thousandth of its radius.
constexpr int kCircleLines = 72;

/// Curves along a profile. Chosen: two of them are near the outline from any side.
constexpr int kOutlineMeridians = 4;

Vec3 pointAt(const engine::ProfilePoint& point, double share, const Vec3& origin) {
    const double angle = 2.0 * std::numbers::pi * share;
    return origin + Vec3(point.radius * std::cos(angle), point.height, point.radius * std::sin(angle));
}

/// Whether a profile turns by more than 30 degrees at a point, or ends there.
bool isCorner(const Profile& points, std::size_t k, bool isClosed) {
    const std::size_t count = points.size();
    if (!isClosed && (k == 0 || k + 1 == count)) return true;
    const engine::ProfilePoint& before = points[(k + count - 1) % count];
    const engine::ProfilePoint& after = points[(k + 1) % count];
    const Vec3 in(points[k].radius - before.radius, points[k].height - before.height, 0.0);
    const Vec3 out(after.radius - points[k].radius, after.height - points[k].height, 0.0);
    return in.dot(out) < kSharp * in.norm() * out.norm();
}

}  // namespace

std::vector<Line> edgesOfBox(const Vec3& minimum, const Vec3& maximum) {
    // Bits 0, 1 and 2 of a corner's number select the maximum in x, y and z. From every corner, an edge runs along each
    // axis in which the corner is at the minimum.
    const auto corner = [&](unsigned number) {
        return Vec3((number & 1U) != 0 ? maximum.x() : minimum.x(), (number & 2U) != 0 ? maximum.y() : minimum.y(),
                    (number & 4U) != 0 ? maximum.z() : minimum.z());
    };
    std::vector<Line> lines;
    for (unsigned number = 0; number < 8; ++number)
        for (unsigned axis = 1; axis < 8; axis *= 2)
            if ((number & axis) == 0) lines.emplace_back(corner(number), corner(number | axis));
    return lines;
}

std::vector<Line> sharpEdges(const render::SolidMesh& mesh, const Vec3& origin) {
    const auto pointOf = [&](std::uint32_t k) {
        const glm::vec3& p = mesh.positions[k];
        return Vec3(p.x, p.y, p.z);
    };
    // Points at a sharp edge are there once for each normal, so that edges are told by the places of their ends.
    using Place = std::tuple<float, float, float>;
    const auto placeOf = [&](std::uint32_t k) {
        return Place(mesh.positions[k].x, mesh.positions[k].y, mesh.positions[k].z);
    };
    std::map<std::pair<Place, Place>, Vec3> normals;
    std::vector<Line> lines;
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
        const Vec3 normal = (pointOf(triangle[1]) - pointOf(triangle[0]))
                                .cross(pointOf(triangle[2]) - pointOf(triangle[0]))
                                .normalized();
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = triangle[side];
            const std::uint32_t to = triangle[(side + 1) % 3];
            const auto ends = std::minmax(placeOf(from), placeOf(to));
            const auto [other, isFirst] = normals.emplace(ends, normal);
            if (!isFirst && other->second.dot(normal) < kSharp)
                lines.emplace_back(origin + pointOf(from), origin + pointOf(to));
        }
    }
    return lines;
}

std::vector<Line> outlinesOf(const ProfileSpec& spec, const Vec3& origin) {
    std::vector<Line> lines;
    for (std::size_t k = 0; k < spec.points.size(); ++k) {
        const bool isRound = spec.isSmooth && (spec.isClosed || (k > 0 && k + 1 < spec.points.size()));
        if (spec.points[k].radius == 0.0 || isRound || !isCorner(spec.points, k, spec.isClosed)) continue;
        for (int line = 0; line < kCircleLines; ++line)
            lines.emplace_back(pointAt(spec.points[k], static_cast<double>(line) / kCircleLines, origin),
                               pointAt(spec.points[k], static_cast<double>(line + 1) / kCircleLines, origin));
    }
    const Profile curve = refinedProfile(spec);
    for (int meridian = 0; meridian < kOutlineMeridians; ++meridian) {
        const double share = static_cast<double>(meridian) / kOutlineMeridians;
        for (std::size_t k = 0; k + (spec.isClosed ? 0 : 1) < curve.size(); ++k) {
            const engine::ProfilePoint& next = curve[(k + 1) % curve.size()];
            if (curve[k].radius == 0.0 && next.radius == 0.0) continue;
            lines.emplace_back(pointAt(curve[k], share, origin), pointAt(next, share, origin));
        }
    }
    return lines;
}

}  // namespace scenes
