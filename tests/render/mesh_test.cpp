// The surface of metaballs as a mesh: closed, on the oracle's surface, with its volume, the same for any number of
// threads, and in memory that the surface takes.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "render/mesh/ball_blocks.h"
#include "render/mesh/isosurface.h"
#include "render/mesh/mesh_files.h"
#include "render/mesh/sampled_field.h"
#include "render/mesh/separate_sheets.h"
#include "render/mesh/surface_mesh.h"
#include "studies/oracle/oracle.h"
#include "studies/pictures/level_pool.h"
#include "studies/pictures/pictures.h"
#include "tests/render/pictures.h"

using namespace pictures;
using glm::dvec3;
using render::TriangleMesh;

namespace {

/// Whether a test that needs OpenVDB must be skipped.
bool lacksOpenVdb() {
    if (!render::openVdbVersion().empty()) return false;
    WARN("skipped: this build has no OpenVDB");
    return true;
}

/// A cloud of metaballs with colors, many of which touch, and velocities that depend on the position.
render::View blobs(int count, render::Skin skin = render::Skin::plain) {
    render::View view = cloud(count);
    view.style = render::Style::metaballs;
    view.field.skin = skin;
    return view;
}

TriangleMesh meshOf(const render::View& view, double cell) {
    std::vector<glm::vec3> velocities;
    for (const render::Sphere& particle : view.particles) velocities.push_back(2.0F * particle.center);
    return render::surfaceMesh(view, velocities, cell);
}

/// How the triangles of a mesh hang together.
struct Topology {
    std::size_t open = 0;      ///< directed edges whose opposite is missing
    std::size_t repeated = 0;  ///< directed edges that occur more than once
    std::size_t unused = 0;    ///< vertices without triangles
    std::size_t fans = 0;      ///< vertices whose triangles form more than one fan
};

Topology topologyOf(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> after;  // the third vertex at a directed edge
    std::vector<std::size_t> triangles(mesh.positions.size(), 0);
    std::vector<std::uint32_t> any(mesh.positions.size(), 0);
    Topology topology;
    for (const render::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            if (!after.insert({{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]}).second) ++topology.repeated;
            ++triangles[t[k]];
            any[t[k]] = t[(k + 1) % 3];
        }
    for (const auto& [edge, third] : after) topology.open += after.count({edge.second, edge.first}) == 0 ? 1U : 0U;
    if (topology.open + topology.repeated > 0) return topology;
    for (std::uint32_t vertex = 0; vertex < triangles.size(); ++vertex) {
        if (triangles[vertex] == 0) ++topology.unused;
        if (triangles[vertex] == 0) continue;
        std::size_t count = 0;
        for (std::uint32_t at = any[vertex]; count == 0 || at != any[vertex]; ++count) at = after[{vertex, at}];
        topology.fans += count == triangles[vertex] ? 0U : 1U;
    }
    return topology;
}

void checkClosed(const TriangleMesh& mesh) {
    const Topology topology = topologyOf(mesh);
    CHECK(topology.open == 0);
    CHECK(topology.repeated == 0);
    CHECK(topology.unused == 0);
    CHECK(topology.fans == 0);
}

struct Distances {
    double mean = 0.0, worst = 0.0;  ///< m
    double normal = 0.0;             ///< largest angle of a normal to the oracle's, as 1 - cosine
    std::size_t missed = 0;
};

/// How far vertices are from the oracle's surface along their normals. Each ray starts outside, a tenth of a cell away,
/// and missed ones find nothing within twice that.
Distances distancesOf(const render::View& view, const TriangleMesh& mesh, double cell) {
    const oracle::Scene scene(view);
    Distances distances;
    for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
        const dvec3 normal(mesh.normals[k]);
        const double away = 0.1 * cell;
        const oracle::Hit hit = oracle::trace(scene, {mesh.positions[k] + away * normal, -normal});
        const double off = std::abs(hit.distance - away);
        // A ray that starts inside of another part of the surface hits it at distance 0.
        if (hit.kind != oracle::Hit::Kind::particle || hit.distance == 0.0 || off > away) {
            ++distances.missed;
            continue;
        }
        distances.mean += off;
        distances.worst = std::max(distances.worst, off);
        distances.normal = std::max(distances.normal, 1.0 - dot(hit.normal, normal));
    }
    distances.mean /= static_cast<double>(std::max<std::size_t>(mesh.positions.size() - distances.missed, 1));
    return distances;
}

/// A cube of particles on a lattice with a spacing of 1 m.
render::View block(int side) {
    render::View view;
    view.style = render::Style::metaballs;
    for (int k = 0; k < side * side * side; ++k)
        view.particles.push_back({glm::vec3(k % side, k / side % side, k / side / side), 0.658F, glm::vec3(0.5F)});
    return view;
}

std::string bytesOn(int threads, const render::View& view, double cell) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::string bytes;
    arena.execute([&] {
        const TriangleMesh mesh = meshOf(view, cell);
        render::GridLabel label;
        label.cell = cell;
        bytes = render::encodePly(mesh, {}) + render::encodeObj(mesh, {}) + render::encodeLevelSet(mesh, label);
    });
    return bytes;
}

/// A cube from one corner to the opposite one as twelve triangles over vertices of its own, facing outward.
void addCube(TriangleMesh& mesh, const dvec3& low, double side) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (unsigned k = 0; k < 8; ++k) mesh.positions.push_back(low + side * dvec3(k & 1U, k >> 1U & 1U, k >> 2U & 1U));
    for (const render::Triangle& t : std::vector<render::Triangle>{{0, 2, 3},
                                                                   {0, 3, 1},
                                                                   {4, 5, 7},
                                                                   {4, 7, 6},
                                                                   {0, 1, 5},
                                                                   {0, 5, 4},
                                                                   {2, 6, 7},
                                                                   {2, 7, 3},
                                                                   {0, 4, 6},
                                                                   {0, 6, 2},
                                                                   {1, 3, 7},
                                                                   {1, 7, 5}})
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// Makes vertices at the same position one.
void weld(TriangleMesh& mesh) {
    for (render::Triangle& triangle : mesh.triangles)
        for (std::uint32_t& vertex : triangle)
            vertex = static_cast<std::uint32_t>(
                std::find(mesh.positions.begin(), mesh.positions.end(), mesh.positions[vertex]) -
                mesh.positions.begin());
}

}  // namespace

TEST_CASE("A single particle's mesh is a sphere of its radius", "[mesh]") {
    if (lacksOpenVdb()) return;
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic}) {
        render::View view;
        view.field.skin = skin;
        view.particles = {{glm::vec3(1.3F, -0.7F, 2.1F), 0.3F, glm::vec3(0.1F, 0.5F, 0.9F)}};
        const TriangleMesh mesh = render::surfaceMesh(view, std::vector<glm::vec3>{{1.0F, 2.0F, 3.0F}}, 0.05);
        checkClosed(mesh);
        REQUIRE(mesh.positions.size() > 100);
        const double radius = double(view.particles[0].radius);
        for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
            const dvec3 off = mesh.positions[k] - dvec3(view.particles[0].center);
            // The kernel's single-precision constants are off by 1e-7 of a field that rises by about 1 a radius.
            CHECK(std::abs(glm::length(off) - radius) < 1e-6 * radius);
            CHECK(dot(off / glm::length(off), dvec3(mesh.normals[k])) > 1.0 - 1e-6);
            CHECK(glm::length(mesh.colors[k] - view.particles[0].color) < 1e-6F);
            CHECK(glm::length(mesh.velocities[k] - glm::vec3(1.0F, 2.0F, 3.0F)) < 1e-6F);
        }
        // Chords of a cell cut off about cell^2 / (4 radius^2) of the volume, here 0.7 %.
        const double sphere = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3.0);
        CHECK(render::volumeOf(mesh) == Approx(sphere).epsilon(0.02));
        CHECK(render::volumeOf(mesh) < sphere);
    }
}

TEST_CASE("Meshes of clouds are closed, turned outward and on the oracle's surface", "[mesh]") {
    if (lacksOpenVdb()) return;
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic})
        for (const double cell : {1.0, 0.5, 0.33}) {
            const render::View view = blobs(400, skin);
            const double radius = oracle::meanRadius(view);
            const TriangleMesh mesh = meshOf(view, cell * radius);
            CAPTURE(cell, skin == render::Skin::smooth, mesh.triangles.size());
            checkClosed(mesh);
            CHECK(render::volumeOf(mesh) > 0.0);
            const Distances distances = distancesOf(view, mesh, cell * radius);
            CAPTURE(distances.mean / radius, distances.worst / radius, distances.normal);
            CHECK(distances.mean < 0.002 * radius);
            // The rest: rays along which another part of the surface is nearer.
            CHECK(distances.missed * 100 < mesh.positions.size());
        }
}

TEST_CASE("Fields with every kind of touching surfaces give closed meshes", "[mesh]") {
    if (lacksOpenVdb()) return;
    // Fields of small balls on few nodes: cells with ambiguous faces, slivers, lone nodes.
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        render::View view;
        view.field.reach = 1.6F;
        for (int k = 0; k < 300; ++k) {
            const auto at = [&] { return 0.01F * static_cast<float>(random() % 1001); };
            const float x = at(), y = at(), z = at();
            view.particles.push_back({glm::vec3(x, y, z), 0.5F + 0.05F * at(), glm::vec3(0.5F)});
        }
        INFO("seed " << seed);
        const TriangleMesh mesh = meshOf(view, 0.9);
        REQUIRE(mesh.triangles.size() > 1000);
        checkClosed(mesh);
    }
}

TEST_CASE("A level pool keeps its volume", "[mesh][long]") {
    if (lacksOpenVdb()) return;
    render::View appearance;
    appearance.style = render::Style::metaballs;
    appearance.field = {3.0F, render::Skin::smooth};
    const render::View view = studies::levelPool(appearance);
    const auto count = static_cast<double>(view.particles.size());
    // Of one lattice cell a particle. Points of the oracle's field that are 0.1 radii apart tell the depth of the pool,
    // nine radii, to about a hundredth of a radius and the volume to 0.001. At 0.25 radii, as in `globular study
    // pictures`, they find 0.996; at 0.05 radii it is 0.9935.
    const double volume = studies::fieldVolume(view, 0.1) / count;
    CHECK(volume == Approx(0.9937).margin(0.0005));
    for (const double cell : {0.5, 0.25}) {
        const TriangleMesh mesh = meshOf(view, cell * 0.658);
        checkClosed(mesh);
        // Flat triangles with sides of half a radius lie 0.0065 radii inside in the mean, on two sides of the pool.
        CHECK(render::volumeOf(mesh) / count == Approx(volume).margin(0.0015));
    }
}

TEST_CASE("A mesh has the same bytes for any number of threads", "[mesh]") {
    if (lacksOpenVdb()) return;
    const render::View view = blobs(400, render::Skin::smooth);
    const std::string one = bytesOn(1, view, 0.1);
    REQUIRE(one.size() > 100000);
    CHECK(one == bytesOn(2, view, 0.1));
    CHECK(one == bytesOn(7, view, 0.1));
}

TEST_CASE("No particles give an empty mesh in valid files", "[mesh]") {
    if (lacksOpenVdb()) return;
    render::View view;
    for (const std::size_t count : {0U, 1U}) {
        view.particles.assign(count, {glm::vec3(0.0F), 0.0F, glm::vec3(1.0F)});  // with a radius of 0
        const TriangleMesh mesh = meshOf(view, 0.1);
        CHECK(mesh.positions.empty());
        CHECK(mesh.triangles.empty());
        CHECK(render::volumeOf(mesh) == 0.0);
        const std::string ply = render::encodePly(mesh, {{}, {"empty"}});
        CHECK(ply.find("element vertex 0\n") != std::string::npos);
        CHECK(ply.find("element face 0\n") != std::string::npos);
        CHECK(ply.ends_with("end_header\n"));
        CHECK(render::encodeObj(mesh, {{}, {"empty"}}) == "# empty\n");
        CHECK_FALSE(render::encodeLevelSet(mesh, {}).empty());
    }
}

TEST_CASE("Blocks are kept at the surface alone", "[mesh]") {
    // Two drops in a tank of a million radii.
    render::View drops;
    for (const float x : {-50000.0F, 50000.0F}) drops.particles.push_back({glm::vec3(x, 3.0F, 0.0F), 0.1F, {}});
    const render::BallBlocks few(drops, 0.05);
    CHECK(few.blocks().size() <= 2 * 27);
    const render::SampledField both = render::sampleNearSurface(few, render::surfaceThreshold(drops.field));
    CHECK(both.blocks.size() <= few.blocks().size());
    // A cube of balls: most blocks are inside as a whole and take no values.
    const render::View full = block(30);
    const render::BallBlocks balls(full, 0.5 * 0.658);
    const render::SampledField field = render::sampleNearSurface(balls, render::surfaceThreshold(full.field));
    // Along a side lie 12 blocks; at most the outer three layers of each side are near the surface.
    CHECK(field.inside.size() >= 6 * 6 * 6);
    CHECK(field.blocks.size() + field.inside.size() <= balls.blocks().size());
    CHECK(field.values.size() == field.blocks.size());
}

TEST_CASE("Blocks have the field of all balls", "[mesh]") {
    for (const render::Skin skin : {render::Skin::plain, render::Skin::smooth, render::Skin::anisotropic}) {
        const render::View view = blobs(200, skin);
        const double cell = 0.37 * oracle::meanRadius(view);
        const render::BallBlocks balls(view, cell);
        const oracle::Scene scene(view);
        const double most = oracle::fieldAt(scene, dvec3(view.particles[0].center));
        REQUIRE(balls.blocks().size() > 50);
        for (std::size_t k = 0; k < balls.blocks().size(); k += 7) {
            render::BlockNodes field;
            balls.sample(k, field);
            for (int node = 0; node < 512; node += 37) {
                const glm::ivec3 at = 8 * balls.blocks()[k] + glm::ivec3(node / 64, node / 8 % 8, node % 8);
                // Single precision: a sum of some tens of kernels, each off by some 1e-6.
                CHECK(double(field[static_cast<std::size_t>(node)]) ==
                      Approx(oracle::fieldAt(scene, cell * dvec3(at))).margin(2e-5 * std::max(most, 1.0)));
            }
        }
    }
}

TEST_CASE("Sheets that touch are taken apart", "[mesh]") {
    for (const dvec3 second : {dvec3(1.0, 1.0, 0.0), dvec3(1.0, 1.0, 1.0), dvec3(-1.0, 1.0, 0.0)}) {
        TriangleMesh mesh;
        addCube(mesh, dvec3(0.0), 1.0);
        addCube(mesh, second, 1.0);
        weld(mesh);
        const Topology before = topologyOf(mesh);
        REQUIRE(before.repeated + before.fans > 0);  // the test can fail
        const double volume = render::volumeOf(mesh);
        const auto sources = render::separateSheets(mesh);
        // Two new vertices at a common edge, one at a common vertex.
        CHECK(sources.size() == (second.z == 0.0 ? 2U : 1U));
        CHECK(mesh.positions.size() == 16 + sources.size());
        const Topology after = topologyOf(mesh);
        CHECK(after.open + after.repeated + after.fans == 0);
        CHECK(render::volumeOf(mesh) == Approx(volume));
        // Both are whole: no triangle of one cube has a vertex of the other.
        for (const render::Triangle& t : mesh.triangles) {
            const dvec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0;
            for (const std::uint32_t vertex : t) CHECK(glm::length(mesh.positions[vertex] - middle) < 1.0);
        }
    }
}

TEST_CASE("An open mesh is noticed", "[mesh]") {
    TriangleMesh mesh;
    addCube(mesh, dvec3(0.0), 1.0);
    CHECK(topologyOf(mesh).open == 0);
    CHECK(render::volumeOf(mesh) == Approx(1.0));
    mesh.triangles.pop_back();
    CHECK(topologyOf(mesh).open == 3);
    CHECK_THROWS_AS(render::separateSheets(mesh), std::logic_error);
}
