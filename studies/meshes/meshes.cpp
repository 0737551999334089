// Distances are measured from points on a mesh to the oracle's surface, which shares no code with what made the mesh.
#include "studies/meshes/meshes.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "render/mesh/mesh_files.h"
#include "render/mesh/surface_mesh.h"
#include "studies/common/report.h"
#include "studies/common/timing.h"
#include "studies/oracle/oracle.h"
#include "studies/pictures/dam_break_view.h"
#include "studies/pictures/level_pool.h"
#include "studies/pictures/pictures.h"

namespace studies {
namespace {

/// A point on a mesh, and the direction along which the surface is looked for.
struct Probe {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};
};

/// Evenly chosen vertices of a mesh.
std::vector<Probe> vertexProbes(const render::TriangleMesh& mesh, std::size_t most) {
    const std::size_t stride = mesh.positions.size() / most + 1;
    std::vector<Probe> probes;
    for (std::size_t k = 0; k < mesh.positions.size(); k += stride)
        probes.push_back({mesh.positions[k], glm::dvec3(mesh.normals[k])});
    return probes;
}

/// The centers of evenly chosen triangles.
std::vector<Probe> centerProbes(const render::TriangleMesh& mesh, std::size_t most) {
    const std::size_t stride = mesh.triangles.size() / most + 1;
    std::vector<Probe> probes;
    for (std::size_t k = 0; k < mesh.triangles.size(); k += stride) {
        const auto& [a, b, c] = mesh.triangles[k];
        const glm::dvec3 normal(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]);
        probes.push_back({(mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) / 3.0,
                          oracle::unitOr(normal, glm::dvec3(0.0, 1.0, 0.0))});
    }
    return probes;
}

/// How far the surface is from points along their normals. Rays that start half a radius outside, but within another
/// part of the surface, start nearer, down to a hundredth of a radius; points where that does not help are left out.
SurfaceDistance distanceOf(const oracle::Scene& scene, const std::vector<Probe>& probes) {
    const double radius = oracle::meanRadius(scene.view);
    std::vector<double> distances(probes.size(), -1.0);
    tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t k) {
        for (double away = 0.5 * radius; away > 0.01 * radius && distances[k] < 0.0; away *= 0.5) {
            const oracle::Hit hit =
                oracle::trace(scene, {probes[k].point + away * probes[k].normal, -probes[k].normal});
            if (hit.kind == oracle::Hit::Kind::particle && hit.distance > 0.0 && hit.distance < 2.0 * away)
                distances[k] = std::abs(hit.distance - away) / radius;
        }
    });
    SurfaceDistance result;
    std::size_t count = 0;
    for (const double distance : distances) {
        if (distance < 0.0) continue;
        result.mean += distance;
        result.worst = std::max(result.worst, distance);
        ++count;
    }
    result.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
    return result;
}

/// The liquid of a view alone.
render::View liquidOf(render::View view, render::Skin skin) {
    view.field.skin = skin;
    view.ground.reset();
    view.sphereObstacles.clear();
    view.boxObstacles.clear();
    return view;
}

render::TriangleMesh meshOf(const render::View& view, double cell) {
    const std::vector<glm::vec3> atRest(view.particles.size(), glm::vec3(0.0F));
    return render::surfaceMesh(view, atRest, cell * oracle::meanRadius(view));
}

MeshRow measured(const MeshStudySettings& settings, const render::View& view, double cell) {
    MeshRow row;
    row.skin = view.field.skin;
    row.cell = cell;
    render::TriangleMesh mesh;
    std::vector<double> seconds;
    for (int round = 0; round < settings.rounds; ++round)
        seconds.push_back(secondsOf([&] { mesh = meshOf(view, cell); }));
    row.seconds = median(seconds);
    row.vertices = mesh.positions.size();
    row.triangles = mesh.triangles.size();
    row.megabytes = 1e-6 * static_cast<double>(render::encodePly(mesh, {}).size());
    const oracle::Scene scene(view);
    row.atVertices = distanceOf(scene, vertexProbes(mesh, settings.samples));
    row.atCenters = distanceOf(scene, centerProbes(mesh, settings.samples));
    const render::View pool = levelPool(view);
    row.pool = render::volumeOf(meshOf(pool, cell)) / static_cast<double>(pool.particles.size());
    return row;
}

}  // namespace

std::vector<MeshRow> measureMeshes(const MeshStudySettings& settings,
                                   const std::function<void(const std::vector<MeshRow>&)>& listener) {
    std::vector<MeshRow> rows;
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic}) {
        const render::View view = liquidOf(damBreakView(settings.particles, render::Style::metaballs), skin);
        for (const double cell : settings.cells) {
            rows.push_back(measured(settings, view, cell));
            listener(rows);
        }
    }
    return rows;
}

std::string meshesCsv(const std::vector<MeshRow>& rows) {
    std::string csv =
        "skin,cell_radii,vertices,triangles,ms,ply_mb,vertices_mean_radii,vertices_worst_radii,triangles_mean_radii,"
        "triangles_worst_radii,pool_volume\n";
    for (const MeshRow& row : rows)
        csv += csvFields(nameOf(row.skin), row.cell, row.vertices, row.triangles, 1e3 * row.seconds, row.megabytes,
                         row.atVertices.mean, row.atVertices.worst, row.atCenters.mean, row.atCenters.worst, row.pool) +
               "\n";
    return csv;
}

}  // namespace studies
