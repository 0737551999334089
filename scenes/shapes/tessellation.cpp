#include "scenes/shapes/tessellation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/rotation.h"

namespace scenes {
namespace {

using engine::ProfilePoint;
using engine::Vec3;

/// Meridians of a solid of revolution. Chosen: chords are off the circle by 1 - cos(180 / 96 degrees) = 5e-4 radii.
constexpr int kMeridians = 96;

/// Chords of a wall's rounded end, half a circle.
constexpr int kEndChords = 24;

constexpr double kSharpEdge = 0.866;  ///< cosine of 30 degrees, from which on the corner of a profile is sharp
constexpr double kMeshEdge = 0.766;   ///< cosine of 40 degrees, from which on the edge of a mesh is sharp

/// A point of the outline of a turned solid, with the unit normal of the surface there.
struct OutlineNode {
    ProfilePoint point, normal;
};

/// A stretch of the outline, from one node to the next. Seen along it, the solid is to the left.
struct OutlineEdge {
    OutlineNode start, end;
};

glm::vec3 toFloats(const Vec3& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

ProfilePoint directionOf(const ProfilePoint& a, const ProfilePoint& b) {
    const double radius = b.radius - a.radius;
    const double height = b.height - a.height;
    const double length = std::sqrt(radius * radius + height * height);
    return {radius / length, height / length};
}

/// The normal to the right of a direction.
ProfilePoint rightOf(const ProfilePoint& direction) {
    return {direction.height, -direction.radius};
}

ProfilePoint unit(const ProfilePoint& a) {
    const double length = std::sqrt(a.radius * a.radius + a.height * a.height);
    return {a.radius / length, a.height / length};
}

/// The normals of two edges where they meet: one in the middle, or both as they are if the corner is sharp.
std::array<ProfilePoint, 2> joinedNormals(const ProfilePoint& before, const ProfilePoint& after) {
    if (before.radius * after.radius + before.height * after.height < kSharpEdge) return {before, after};
    const ProfilePoint mean = unit({before.radius + after.radius, before.height + after.height});
    return {mean, mean};
}

std::vector<OutlineEdge> solidOutline(Profile points) {
    if (twiceArea(points) < 0.0) std::reverse(points.begin(), points.end());
    std::vector<OutlineEdge> edges;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const ProfilePoint& a = points[k];
        const ProfilePoint& b = points[(k + 1) % points.size()];
        if (a.radius == b.radius && a.height == b.height) continue;
        const ProfilePoint normal = rightOf(directionOf(a, b));
        edges.push_back({{a, normal}, {b, normal}});
    }
    const std::vector<OutlineEdge> flat = edges;
    for (std::size_t k = 0; k < flat.size(); ++k) {
        const std::size_t next = (k + 1) % flat.size();
        if (flat[k].end.point.radius == 0.0) continue;  // the tip of a cone stays sharp
        const auto normals = joinedNormals(flat[k].end.normal, flat[next].start.normal);
        edges[k].end.normal = normals[0];
        edges[next].start.normal = normals[1];
    }
    return edges;
}

/// A point of the profile moved along a normal by half the thickness, but not beyond the axis.
OutlineNode moved(const ProfilePoint& point, const ProfilePoint& normal, double halfThickness) {
    return {{std::max(point.radius + halfThickness * normal.radius, 0.0), point.height + halfThickness * normal.height},
            normal};
}

/// Adds an arc around a point of the profile that turns a normal counterclockwise by an angle, in degrees.
void appendArc(std::vector<OutlineEdge>& edges, const ProfilePoint& center, const ProfilePoint& from, double degrees,
               double halfThickness) {
    const int chords = std::max(1, static_cast<int>(std::ceil(degrees * kEndChords / 180.0)));
    const auto nodeAt = [&](int k) {
        const engine::SineAndCosine turn = engine::sineAndCosineOfDegrees(degrees * k / chords);
        const ProfilePoint normal{from.radius * turn.cosine - from.height * turn.sine,
                                  from.radius * turn.sine + from.height * turn.cosine};
        return moved(center, normal, halfThickness);
    };
    for (int k = 0; k < chords; ++k) edges.push_back({nodeAt(k), nodeAt(k + 1)});
}

/// The right side of a wall. At its outer corners there are arcs; at inner ones both sides end inside the wall.
void appendSide(std::vector<OutlineEdge>& edges, const Profile& chain, bool isRing, double halfThickness) {
    const std::size_t count = chain.size();
    const std::size_t edgeCount = isRing ? count : count - 1;
    for (std::size_t k = 0; k < edgeCount; ++k) {
        const ProfilePoint& a = chain[k];
        const ProfilePoint& b = chain[(k + 1) % count];
        const ProfilePoint normal = rightOf(directionOf(a, b));
        edges.push_back({moved(a, normal, halfThickness), moved(b, normal, halfThickness)});
        if (!isRing && k + 1 == edgeCount) continue;
        const ProfilePoint after = rightOf(directionOf(b, chain[(k + 2) % count]));
        const double sine = normal.radius * after.height - normal.height * after.radius;
        const double cosine = normal.radius * after.radius + normal.height * after.height;
        if (sine <= 0.0) continue;
        if (cosine > kSharpEdge)  // one chord is enough, of which the normals are those of its ends
            edges.push_back({moved(b, normal, halfThickness), moved(b, after, halfThickness)});
        else
            appendArc(edges, b, normal, std::atan2(sine, cosine) * 57.29577951308232, halfThickness);
    }
}

std::vector<OutlineEdge> wallOutline(const Profile& profile, bool isClosed, double halfThickness) {
    Profile chain;
    for (const ProfilePoint& point : profile)
        if (chain.empty() || point.radius != chain.back().radius || point.height != chain.back().height)
            chain.push_back(point);
    std::vector<OutlineEdge> edges;
    if (chain.size() == 1) {
        appendArc(edges, chain[0], {0.0, -1.0}, 360.0, halfThickness);
        return edges;
    }
    const bool isOnAxis = chain.front().radius == 0.0 && chain.back().radius == 0.0;
    const bool isRing = isClosed && chain.size() > 2 && !isOnAxis;
    for (int side = 0; side < 2; ++side) {
        appendSide(edges, chain, isRing, halfThickness);
        if (!isRing)
            appendArc(edges, chain.back(), rightOf(directionOf(chain[chain.size() - 2], chain.back())), 180.0,
                      halfThickness);
        std::reverse(chain.begin(), chain.end());
    }
    return edges;
}

void appendBand(render::SolidMesh& mesh, const OutlineEdge& edge) {
    const bool startsOnAxis = edge.start.point.radius == 0.0;
    const bool endsOnAxis = edge.end.point.radius == 0.0;
    if (startsOnAxis && endsOnAxis) return;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k <= kMeridians; ++k) {
        const engine::SineAndCosine turn = engine::sineAndCosineOfDegrees(360.0 * k / kMeridians);
        for (const OutlineNode& node : {edge.start, edge.end}) {
            mesh.positions.push_back(
                toFloats({node.point.radius * turn.cosine, node.point.height, node.point.radius * turn.sine}));
            mesh.normals.push_back(
                toFloats({node.normal.radius * turn.cosine, node.normal.height, node.normal.radius * turn.sine}));
        }
    }
    for (std::uint32_t k = 0; k < kMeridians; ++k) {
        const std::uint32_t start = first + 2 * k;
        if (!endsOnAxis) mesh.triangles.push_back({start, start + 1, start + 3});
        if (!startsOnAxis) mesh.triangles.push_back({start, start + 3, start + 2});
    }
}

}  // namespace

render::SolidMesh revolutionMesh(const Profile& profile, bool isClosed, double halfThickness) {
    render::SolidMesh mesh;
    const bool isSolid = isClosed && halfThickness == 0.0;
    for (const OutlineEdge& edge : isSolid ? solidOutline(profile) : wallOutline(profile, isClosed, halfThickness))
        appendBand(mesh, edge);
    return mesh;
}

render::SolidMesh ballMesh(double radius) {
    constexpr int kSteps = 60;  // from pole to pole
    Profile half;
    for (int k = 0; k <= kSteps; ++k) {
        const double angle = std::numbers::pi * (double(k) / kSteps - 0.5);
        half.push_back({k % kSteps == 0 ? 0.0 : radius * std::cos(angle), radius * std::sin(angle)});
    }
    return revolutionMesh(half, true, 0.0);
}

render::SolidMesh cuboidMesh(const Vec3& size) {
    render::SolidMesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            // Seen from outside, the next axis and the one after it run counterclockwise on the positive side.
            const Vec3 normal = side * Vec3::Unit(axis);
            const Vec3 across = side * 0.5 * size[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3);
            const Vec3 up = 0.5 * size[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
            const Vec3 middle = 0.5 * size[axis] * normal;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const Vec3& corner : {Vec3(middle - across - up), Vec3(middle + across - up),
                                       Vec3(middle + across + up), Vec3(middle - across + up)}) {
                mesh.positions.push_back(toFloats(corner));
                mesh.normals.push_back(toFloats(normal));
            }
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
        }
    return mesh;
}

render::SolidMesh smoothMesh(const Mesh& mesh) {
    std::vector<Vec3> normals;  // twice the area long
    std::vector<std::vector<std::uint32_t>> around(mesh.points.size());
    for (std::uint32_t index = 0; index < mesh.triangles.size(); ++index) {
        const auto& triangle = mesh.triangles[index];
        const Vec3 one = mesh.points[triangle[1]] - mesh.points[triangle[0]];
        const Vec3 other = mesh.points[triangle[2]] - mesh.points[triangle[0]];
        normals.push_back(one.cross(other));
        for (const std::uint32_t point : triangle) around[point].push_back(index);
    }
    const auto lengthOf = [](const Vec3& vector) { return std::sqrt(engine::squaredLength(vector)); };
    render::SolidMesh result;
    std::vector<std::vector<std::uint32_t>> madeOf(mesh.points.size());  // the vertices made of each point
    for (std::size_t index = 0; index < mesh.triangles.size(); ++index) {
        const double length = lengthOf(normals[index]);
        if (length == 0.0) continue;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t point = mesh.triangles[index][k];
            Vec3 sum = Vec3::Zero();
            for (const std::uint32_t neighbor : around[point])
                if (engine::dot(normals[index], normals[neighbor]) >= kMeshEdge * length * lengthOf(normals[neighbor]))
                    sum += normals[neighbor];
            const glm::vec3 normal = toFloats(sum / lengthOf(sum));
            auto& made = madeOf[point];
            const auto same =
                std::ranges::find_if(made, [&](std::uint32_t vertex) { return result.normals[vertex] == normal; });
            if (same == made.end()) {
                corners[k] = static_cast<std::uint32_t>(result.positions.size());
                made.push_back(corners[k]);
                result.positions.push_back(toFloats(mesh.points[point]));
                result.normals.push_back(normal);
            } else {
                corners[k] = *same;
            }
        }
        result.triangles.push_back(corners);
    }
    return result;
}

}  // namespace scenes
