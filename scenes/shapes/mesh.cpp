#include "scenes/shapes/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "engine/obstacles/bounding_box_tree.h"

namespace scenes {
namespace {

using engine::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

bool isBefore(const Vec3& a, const Vec3& b) {
    if (a.x() != b.x()) return a.x() < b.x();
    if (a.y() != b.y()) return a.y() < b.y();
    return a.z() < b.z();
}

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

std::array<Vec3, 3> cornersOf(const Mesh& mesh, const Triangle& triangle) {
    return {mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]};
}

/// Distance from a point along a unit direction to a triangle; nothing if the ray misses it. Moeller and Trumbore 1997.
std::optional<double> hitDistance(const Vec3& origin, const Vec3& direction, const std::array<Vec3, 3>& corners) {
    const Vec3 one = corners[1] - corners[0];
    const Vec3 other = corners[2] - corners[0];
    const Vec3 normal = cross(direction, other);
    const double determinant = engine::dot(one, normal);
    if (determinant == 0.0) return std::nullopt;
    const Vec3 offset = origin - corners[0];
    const double u = engine::dot(offset, normal) / determinant;
    const Vec3 turned = cross(offset, one);
    const double v = engine::dot(direction, turned) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return std::nullopt;
    return engine::dot(other, turned) / determinant;
}

/// Calls visit(point) for the middles of equal parts of a triangle whose edges are at most `step` long, or a 32nd of
/// the triangle's.
template <class Visit>
void forEachSample(const std::array<Vec3, 3>& corners, double step, const Visit& visit) {
    const Vec3 one = corners[1] - corners[0];
    const Vec3 other = corners[2] - corners[0];
    const double longest = std::sqrt(
        std::max({engine::squaredLength(one), engine::squaredLength(other), engine::squaredLength(other - one)}));
    const int parts = static_cast<int>(std::clamp(std::ceil(longest / step), 1.0, 32.0));
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts - i; ++j)
            for (int flipped = 0; flipped < (j < parts - i - 1 ? 2 : 1); ++flipped) {
                const double shift = flipped == 1 ? 2.0 / 3.0 : 1.0 / 3.0;
                visit(Vec3(corners[0] + (i + shift) / parts * one + (j + shift) / parts * other));
            }
}

std::string placeText(const Vec3& point) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", point.x(), point.y(), point.z());
}

/// Edges that are on one triangle, or on an odd number of them, as pairs of points in the order of the triangles.
std::vector<std::array<std::uint32_t, 2>> openEdges(const Mesh& mesh) {
    struct Side {
        std::array<std::uint32_t, 2> points;
        std::size_t index;
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            sides.push_back({{low, high}, sides.size()});
        }
    std::ranges::sort(sides, [](const Side& a, const Side& b) {
        return a.points != b.points ? a.points < b.points : a.index < b.index;
    });
    std::vector<Side> open;
    for (std::size_t k = 0; k < sides.size();) {
        std::size_t next = k;
        while (next < sides.size() && sides[next].points == sides[k].points) ++next;
        if ((next - k) % 2 == 1) open.push_back(sides[k]);
        k = next;
    }
    std::ranges::sort(open, {}, &Side::index);
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const Side& side : open) edges.push_back(side.points);
    return edges;
}

double areaOf(const Mesh& mesh) {
    double sum = 0.0;
    for (const Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = cornersOf(mesh, triangle);
        sum += 0.5 * std::sqrt(engine::squaredLength(cross(b - a, c - a)));
    }
    return sum;
}

}  // namespace

Mesh welded(const Mesh& mesh) {
    std::vector<std::uint32_t> order(mesh.points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        if (isBefore(mesh.points[a], mesh.points[b])) return true;
        return !isBefore(mesh.points[b], mesh.points[a]) && a < b;
    });
    std::vector<std::uint32_t> first(order.size());  // the first of the points that are equal to each
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool isNew = k == 0 || isBefore(mesh.points[order[k - 1]], mesh.points[order[k]]);
        first[order[k]] = isNew ? order[k] : first[order[k - 1]];
    }
    Mesh result;
    constexpr std::uint32_t kUnused = 0xffffffff;
    std::vector<std::uint32_t> indexOf(order.size(), kUnused);
    for (const Triangle& triangle : mesh.triangles) {
        Triangle merged{};
        for (std::size_t k = 0; k < 3; ++k) merged[k] = first[triangle[k]];
        if (merged[0] == merged[1] || merged[1] == merged[2] || merged[2] == merged[0]) continue;
        for (std::uint32_t& point : merged) {
            if (indexOf[point] == kUnused) {
                indexOf[point] = static_cast<std::uint32_t>(result.points.size());
                result.points.push_back(mesh.points[point]);
            }
            point = indexOf[point];
        }
        result.triangles.push_back(merged);
    }
    return result;
}

// A closed surface is the sum of the tetrahedra between its triangles and a point, counted negative where the point is
// outside of the triangle. The middle of the bounds keeps them small.
MassProperties massOf(const Mesh& mesh) {
    MassProperties mass;
    if (mesh.triangles.empty()) return mass;
    const Vec3 apex = boundsOf(mesh).middle();
    Vec3 moment = Vec3::Zero();
    for (const Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = cornersOf(mesh, triangle);
        const double volume = engine::dot(a - apex, cross(b - apex, c - apex)) / 6.0;
        mass.volume += volume;
        moment += volume * 0.25 * ((a - apex) + (b - apex) + (c - apex));
    }
    mass.center = mass.volume == 0.0 ? apex : Vec3(apex + moment / mass.volume);
    return mass;
}

engine::BoundingBox boundsOf(const Mesh& mesh) {
    engine::BoundingBox box = engine::BoundingBox::empty();
    for (const Vec3& point : mesh.points) box.include({point, point});
    return box;
}

std::string meshProblem(const Mesh& mesh) {
    if (mesh.triangles.empty()) return "has no triangles with an area";
    for (const Vec3& point : mesh.points)
        if (!point.allFinite()) return "has a point that is not finite";
    if (const auto open = openEdges(mesh); !open.empty())
        return fmt::format(
            "is open: {} edge{} without a second triangle, the first from {} to {}; close the holes in the program "
            "that made it",
            open.size(), open.size() == 1 ? "" : "s", placeText(mesh.points[open[0][0]]),
            placeText(mesh.points[open[0][1]]));
    // A ball has 0.09 times the area to the power of 3/2, a sheet of paper 1e-4 times, a flat mesh its rounding.
    const double area = areaOf(mesh);
    if (std::abs(massOf(mesh).volume) <= 1e-7 * area * std::sqrt(area)) return "encloses no volume: it is flat";
    return "";
}

ThinPlace thinnestPlace(const Mesh& mesh, double thickness) {
    std::vector<engine::BoundingBox> boxes;
    std::vector<Vec3> normals;
    for (const Triangle& triangle : mesh.triangles) {
        const auto [a, b, c] = cornersOf(mesh, triangle);
        boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
        const Vec3 normal = cross(b - a, c - a);
        const double length = std::sqrt(engine::squaredLength(normal));
        normals.push_back(length > 0.0 ? Vec3(normal / length) : Vec3::Zero());
    }
    const engine::BoundingBoxTree tree(boxes);
    ThinPlace thinnest;
    thinnest.thickness = thickness;
    constexpr double kOpposite = -0.9;  // cosine of 154 degrees between the normals of both sides
    for (std::size_t index = 0; index < mesh.triangles.size(); ++index)
        forEachSample(cornersOf(mesh, mesh.triangles[index]), 8.0 * thickness, [&](const Vec3& sample) {
            tree.visitNear(sample, thickness, [&](std::uint32_t other) {
                if (other == index || !(engine::dot(normals[index], normals[other]) < kOpposite)) return;
                const auto distance = hitDistance(sample, -normals[index], cornersOf(mesh, mesh.triangles[other]));
                if (!distance || *distance < 0.0 || *distance >= thinnest.thickness) return;
                thinnest = {true, sample, *distance};
            });
        });
    return thinnest;
}

Mesh centeredMesh(const Mesh& mesh, double scale) {
    const Vec3 middle = boundsOf(mesh).middle();
    Mesh result = mesh;
    for (Vec3& point : result.points) point = scale * (point - middle);
    if (massOf(mesh).volume < 0.0)
        for (Triangle& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
    return result;
}

}  // namespace scenes
