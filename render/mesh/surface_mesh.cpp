// OpenVDB's vertices are off the surface by some hundredths of a cell; Newton's method brings them onto it. Quads are
// split afterwards.
#include "render/mesh/surface_mesh.h"

#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "render/mesh/ball_blocks.h"
#include "render/mesh/isosurface.h"
#include "render/mesh/sampled_field.h"
#include "render/mesh/separate_sheets.h"
#include "render/prepare/skin/skin.h"

namespace render {
namespace {

struct FieldSample {
    double value = 0.0;
    glm::dvec3 gradient{0.0};  ///< 1/m
};

FieldSample fieldAt(const BallBlocks& balls, const glm::dvec3& point) {
    FieldSample sample;
    balls.forEachBallAt(point, [&](const BallBlocks::Ball& ball, const glm::dvec3& offset, double root) {
        sample.value += root * root;
        sample.gradient -= ball.steepness(4.0 * root, offset);  // of (peak - slope^2 offset^2)^2
    });
    return sample;
}

/// Moves a point onto the surface by Newton's method along the gradient. Steps are at most half a cell, stay within a
/// cell of the start and must bring the field closer to the threshold; where there is none such, as where the gradient
/// vanishes, the point stays.
glm::dvec3 ontoSurface(const BallBlocks& balls, double threshold, const glm::dvec3& start) {
    constexpr int kMostSteps = 6;    // three are enough nearly everywhere
    constexpr double kExact = 1e-9;  // cells; the kernels are rounded by some 1e-7
    const double cell = balls.cell();
    glm::dvec3 point = start;
    FieldSample sample = fieldAt(balls, point);
    for (int k = 0; k < kMostSteps; ++k) {
        const double missing = threshold - sample.value;
        const double steepness = std::sqrt(dot(sample.gradient, sample.gradient));
        if (!(steepness > 0.0) || !(std::abs(missing) > kExact * cell * steepness)) break;
        const double length = std::min(std::abs(missing) / steepness, 0.5 * cell);
        const glm::dvec3 next = point + std::copysign(length, missing) / steepness * sample.gradient;
        const FieldSample there = fieldAt(balls, next);
        const glm::dvec3 way = next - start;
        if (dot(way, way) > cell * cell || !(std::abs(threshold - there.value) < std::abs(missing))) break;
        point = next;
        sample = there;
    }
    return point;
}

double squaredDistance(const glm::dvec3& a, const glm::dvec3& b) {
    return dot(a - b, a - b);
}

/// Two triangles for each quad, along its shorter diagonal.
void triangulate(const QuadMesh& quads, TriangleMesh& mesh) {
    mesh.triangles.reserve(2 * quads.quads.size());
    for (const auto& [a, b, c, d] : quads.quads) {
        const auto& at = mesh.positions;
        const bool isAcross = squaredDistance(at[b], at[d]) < squaredDistance(at[a], at[c]);
        mesh.triangles.push_back(isAcross ? Triangle{a, b, d} : Triangle{a, b, c});
        mesh.triangles.push_back(isAcross ? Triangle{b, c, d} : Triangle{a, c, d});
    }
}

/// Sets normals, colors and velocities. Where the gradient vanishes, the normal is zero.
void setAttributes(const View& view, std::span<const glm::vec3> velocities, const BallBlocks& balls,
                   TriangleMesh& mesh) {
    const std::size_t count = mesh.positions.size();
    for (auto* values : {&mesh.normals, &mesh.colors, &mesh.velocities}) values->assign(count, glm::vec3(0.0F));
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        glm::dvec3 gradient(0.0), color(0.0), velocity(0.0);
        double sum = 0.0;
        balls.forEachBallAt(mesh.positions[k],
                            [&](const BallBlocks::Ball& ball, const glm::dvec3& offset, double root) {
                                gradient -= ball.steepness(root, offset);
                                color += root * root * glm::dvec3(view.particles[ball.particle].color);
                                velocity += root * root * glm::dvec3(velocities[ball.particle]);
                                sum += root * root;
                            });
        const double length = std::sqrt(dot(gradient, gradient));
        if (length > 0.0) mesh.normals[k] = glm::vec3(-gradient / length);
        if (!(sum > 0.0)) return;
        mesh.colors[k] = glm::vec3(color / sum);
        mesh.velocities[k] = glm::vec3(velocity / sum);
    });
}

/// Gives vertices without a normal the mean of the normals of their triangles, weighted by area.
void completeNormals(TriangleMesh& mesh) {
    const auto isMissing = [&](std::uint32_t vertex) { return mesh.normals[vertex] == glm::vec3(0.0F); };
    std::vector<std::pair<std::uint32_t, glm::dvec3>> sums;
    for (const Triangle& triangle : mesh.triangles) {
        const auto& [a, b, c] = triangle;
        const glm::dvec3 face = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t vertex : triangle)
            if (isMissing(vertex)) sums.emplace_back(vertex, face);
    }
    std::stable_sort(sums.begin(), sums.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t k = 0; k < sums.size();) {
        const std::uint32_t vertex = sums[k].first;
        glm::dvec3 sum(0.0);
        for (; k < sums.size() && sums[k].first == vertex; ++k) sum += sums[k].second;
        const double length = std::sqrt(dot(sum, sum));
        mesh.normals[vertex] = length > 0.0 ? glm::vec3(sum / length) : glm::vec3(0.0F, 1.0F, 0.0F);
    }
}

}  // namespace

TriangleMesh surfaceMesh(const View& view, std::span<const glm::vec3> velocities, double cell) {
    TriangleMesh mesh;
    const BallBlocks balls(view, cell);
    const float threshold = surfaceThreshold(view.field);
    const QuadMesh quads = isosurfaceOf(sampleNearSurface(balls, threshold));
    mesh.positions.resize(quads.points.size());
    tbb::parallel_for(std::size_t{0}, quads.points.size(), [&](std::size_t k) {
        mesh.positions[k] = ontoSurface(balls, double(threshold), cell * quads.points[k]);
    });
    triangulate(quads, mesh);
    separateSheets(mesh);
    setAttributes(view, velocities, balls, mesh);
    completeNormals(mesh);
    return mesh;
}

}  // namespace render
