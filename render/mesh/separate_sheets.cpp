// Each corner of each triangle starts as a vertex of its own, and corners that two triangles share at a common edge are
// united. A vertex with more than one set of united corners is where sheets touch.
#include "render/mesh/separate_sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace render {
namespace {

/// One side of a triangle, from its corner k to the next.
struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< its vertices
    std::uint32_t corner = 0;         ///< 3 times the index of its triangle, plus k
    bool isForward = false;           ///< whether it runs from low to high
};

std::uint32_t nextCorner(std::uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

std::uint32_t vertexAt(const TriangleMesh& mesh, std::uint32_t corner) {
    return mesh.triangles[corner / 3][corner % 3];
}

/// All half edges, those of an edge together.
std::vector<HalfEdge> sortedHalfEdges(const TriangleMesh& mesh) {
    std::vector<HalfEdge> edges(3 * mesh.triangles.size());
    for (std::uint32_t corner = 0; corner < edges.size(); ++corner) {
        const std::uint32_t from = vertexAt(mesh, corner);
        const std::uint32_t to = vertexAt(mesh, nextCorner(corner));
        edges[corner] = {std::min(from, to), std::max(from, to), corner, from < to};
    }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    return edges;
}

/// Sets of corners. The first corner of a set stands for it.
class CornerSets {
 public:
    explicit CornerSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    std::uint32_t find(std::uint32_t corner) {
        while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
        return corner;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

 private:
    std::vector<std::uint32_t> parent_;
};

/// A number that rises from 0 to 4 with the angle of a vector in the plane, without functions that differ between
/// machines; 0 for a zero vector.
double angleRank(double x, double y) {
    const double sum = std::abs(x) + std::abs(y);
    if (!(sum > 0.0)) return 0.0;
    const double share = y / sum;
    if (x < 0.0) return 2.0 - share;
    return y < 0.0 ? 4.0 + share : share;
}

/// Ranks the half edges of an edge by the angle of their triangles around it.
std::vector<std::pair<double, HalfEdge>> aroundEdge(const TriangleMesh& mesh, std::span<const HalfEdge> edge) {
    const glm::dvec3 from = mesh.positions[edge.front().low];
    const glm::dvec3 along = mesh.positions[edge.front().high] - from;
    const auto third = [&](const HalfEdge& half) {
        return mesh.positions[vertexAt(mesh, nextCorner(nextCorner(half.corner)))] - from;
    };
    const glm::dvec3 first = third(edge.front());
    const glm::dvec3 x = first * dot(along, along) - along * dot(along, first);
    const glm::dvec3 y = cross(along, x);
    // y is as much longer than x as the edge is long.
    const double length = std::sqrt(dot(along, along));
    std::vector<std::pair<double, HalfEdge>> ranked;
    for (const HalfEdge& half : edge)
        ranked.emplace_back(angleRank(dot(third(half), x) * length, dot(third(half), y)), half);
    std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    return ranked;
}

/// Unites the corners of two triangles at the ends of an edge that they share in opposite directions.
void join(const HalfEdge& a, const HalfEdge& b, CornerSets& sets) {
    sets.unite(a.corner, nextCorner(b.corner));
    sets.unite(nextCorner(a.corner), b.corner);
}

/// Joins the triangles at an edge in pairs of opposite directions. The outward normal of a triangle that runs forward
/// points to larger angles, that of one that runs backward to smaller ones: the inside is between a backward one and
/// the next forward one.
void joinPairs(const TriangleMesh& mesh, std::span<const HalfEdge> edge, CornerSets& sets) {
    if (edge.size() == 2) return join(edge[0], edge[1], sets);
    auto ranked = aroundEdge(mesh, edge);
    while (!ranked.empty()) {
        std::size_t k = 0;  // a backward one with a forward one right after it, in the cyclic order
        while (ranked[k].second.isForward || !ranked[(k + 1) % ranked.size()].second.isForward) ++k;
        const std::size_t next = (k + 1) % ranked.size();
        join(ranked[k].second, ranked[next].second, sets);
        ranked.erase(ranked.begin() + static_cast<std::ptrdiff_t>(std::max(k, next)));
        ranked.erase(ranked.begin() + static_cast<std::ptrdiff_t>(std::min(k, next)));
    }
}

CornerSets joinTriangles(const TriangleMesh& mesh) {
    const std::vector<HalfEdge> edges = sortedHalfEdges(mesh);
    CornerSets sets(edges.size());
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
        const std::span<const HalfEdge> edge = std::span(edges).subspan(begin, end - begin);
        const auto forward = std::count_if(edge.begin(), edge.end(), [](const HalfEdge& e) { return e.isForward; });
        if (2 * forward != static_cast<std::ptrdiff_t>(edge.size()))
            throw std::logic_error("the mesh is open between its vertices " + std::to_string(edge.front().low) +
                                   " and " + std::to_string(edge.front().high));
        joinPairs(mesh, edge, sets);
    }
    return sets;
}

}  // namespace

std::vector<std::uint32_t> separateSheets(TriangleMesh& mesh) {
    std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    CornerSets sets = joinTriangles(mesh);
    constexpr std::uint32_t kNone = ~0U;
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<std::uint32_t> sources;
    std::vector<bool> isTaken(count, false);
    // The vertex of each set of corners, by the corner that stands for it, which comes before all others.
    std::vector<std::uint32_t> vertexOf(3 * mesh.triangles.size(), kNone);
    for (std::uint32_t corner = 0; corner < vertexOf.size(); ++corner) {
        std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
        std::uint32_t& own = vertexOf[sets.find(corner)];
        if (own == kNone) {
            own = isTaken[vertex] ? count + static_cast<std::uint32_t>(sources.size()) : vertex;
            if (isTaken[vertex]) sources.push_back(vertex);
            isTaken[vertex] = true;
        }
        vertex = own;
    }
    for (const std::uint32_t source : sources) mesh.positions.push_back(glm::dvec3(mesh.positions[source]));
    return sources;
}

}  // namespace render
