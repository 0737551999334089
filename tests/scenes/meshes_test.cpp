// Meshes from files: what is read, what is refused and why, distances from them and bodies that are filled with them.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scenes/shapes/mesh_distances.h"
#include "scenes/shapes/mesh_file.h"
#include "scenes/shapes/tessellation.h"
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

namespace {

using engine::Vec3;
using scenes::Mesh;
using std::numbers::pi;

/// A folder for the files of a test, which is removed at its end.
struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / "globular_meshes_test";
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
        return (path / name).string();
    }
};

Mesh meshOf(const render::SolidMesh& solid) {
    Mesh mesh;
    for (const glm::vec3& point : solid.positions) mesh.points.emplace_back(point.x, point.y, point.z);
    mesh.triangles = solid.triangles;
    return scenes::welded(mesh);
}

Mesh boxMesh(const Vec3& size) {
    return meshOf(scenes::cuboidMesh(size));
}

Mesh turnedMesh(const scenes::Profile& profile, bool isClosed, double halfThickness) {
    return meshOf(scenes::revolutionMesh(profile, isClosed, halfThickness));
}

std::string objOf(const Mesh& mesh, std::size_t leftOut = 0) {
    std::string text;
    for (const Vec3& p : mesh.points) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
    for (std::size_t k = leftOut; k < mesh.triangles.size(); ++k) {
        const auto& t = mesh.triangles[k];
        text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    return text;
}

std::string stlOf(const Mesh& mesh) {
    std::string text = "solid x\n";
    for (const auto& triangle : mesh.triangles) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const auto point : triangle) {
            const Vec3& p = mesh.points[point];
            text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid x\n";
}

std::string plyOf(const Mesh& mesh) {
    std::string text = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.points.size(), mesh.triangles.size());
    for (const Vec3& p : mesh.points) text += fmt::format("{:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
    for (const auto& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return text;
}

std::string problemOf(const std::string& path) {
    try {
        scenes::readMesh(path);
    } catch (const scenes::InputError& error) {
        return error.problems()[0].message;
    }
    return "";
}

/// Whether tests that read meshes must be skipped.
bool lacksAssimp() {
    if (!scenes::assimpVersion().empty()) return false;
    WARN("skipped: this build has no assimp");
    return true;
}

/// Whether tests of distances from meshes must be skipped.
bool lacksOpenVdb() {
    try {
        scenes::distancesOf(boxMesh({1.0, 1.0, 1.0}), {0.1, 0.3}, "box.obj");
        return false;
    } catch (const scenes::InputError& error) {
        CHECK(error.problems()[0].message.find("this build has no OpenVDB") == 0);
        WARN("skipped: this build has no OpenVDB");
        return true;
    }
}

}  // namespace

TEST_CASE("A build without assimp says so of each mesh", "[meshes]") {
    const Folder folder;
    const std::string problem = problemOf(folder.write("box.obj", objOf(boxMesh({1.0, 2.0, 3.0}))));
    CHECK((problem.find("this build has no assimp, which reads meshes") == 0) == scenes::assimpVersion().empty());
}

TEST_CASE("Meshes are read from OBJ, STL and PLY, and their points welded", "[meshes]") {
    if (lacksAssimp()) return;
    const Folder folder;
    const Mesh box = boxMesh({1.0, 2.0, 3.0});
    REQUIRE(box.points.size() == 8);
    for (const std::string& path : {folder.write("box.obj", objOf(box)), folder.write("box.stl", stlOf(box)),
                                    folder.write("box.ply", plyOf(box))}) {
        INFO(path);
        const Mesh mesh = scenes::readMesh(path);
        CHECK(mesh.points.size() == 8);
        CHECK(mesh.triangles.size() == 12);
        CHECK(scenes::massOf(mesh).volume == Approx(6.0));
        CHECK(scenes::boundsOf(mesh).high == Vec3(0.5, 1.0, 1.5));
    }
}

TEST_CASE("What is no closed mesh is refused with its reason and place", "[meshes]") {
    if (lacksAssimp()) return;
    const Folder folder;
    const Mesh box = boxMesh({1.0, 2.0, 3.0});
    CHECK(problemOf(folder.write("open.obj", objOf(box, 1)))
              .find("the mesh is open: 3 edges without a second triangle, the first from (-0.5, ") == 0);
    CHECK(problemOf((folder.path / "none.obj").string()).find("cannot") != std::string::npos);
    CHECK(problemOf(folder.write("broken.stl", "not a mesh")).find("not a mesh in a format that is read") == 0);
    CHECK(problemOf(folder.write("word.xyz", "hello")).find("not a mesh in a format that is read") == 0);
    CHECK(problemOf(folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n")) ==
          "the mesh encloses no volume: it is flat");
    CHECK(problemOf(folder.write("line.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n")) != "");
}

TEST_CASE("Volume and center of mass of a mesh follow from the divergence theorem", "[meshes]") {
    Mesh cone = turnedMesh(engine::frustumProfile(0.5, 0.0, 1.0), true, 0.0);
    for (Vec3& point : cone.points) point += Vec3(5.0, -3.0, 2.0);
    const scenes::MassProperties mass = scenes::massOf(cone);
    CHECK(mass.volume == Approx(pi * 0.25 / 3.0).epsilon(1e-3));
    CHECK((mass.center - Vec3(5.0, -3.25, 2.0)).norm() <= 1e-6);
}

TEST_CASE("Distances from meshes are those of the shapes", "[meshes]") {
    if (lacksOpenVdb()) return;
    const double voxel = 0.02;
    const Mesh ball = turnedMesh({{0.0, 0.0}}, false, 0.5);
    const engine::DistanceGrid grid = scenes::distancesOf(ball, {voxel, 3.0 * voxel}, "ball.obj");
    const Mesh box = boxMesh({0.6, 0.8, 1.0});
    const engine::DistanceGrid boxGrid = scenes::distancesOf(box, {voxel, 3.0 * voxel}, "box.obj");
    for (double x = -0.7; x <= 0.7; x += 0.0637)
        for (double y = -0.7; y <= 0.7; y += 0.0637)
            for (double z = -0.7; z <= 0.7; z += 0.0637) {
                const Vec3 point(x, y, z);
                const double exact = point.norm() - 0.5;
                // A chord of 1/24 of half a circle is off by r (1 - cos(pi/48)); a voxel by 3 h^2 / 8 r, in a bent
                // field.
                if (exact > -0.3 && exact < 2.0 * voxel)
                    CHECK(std::abs(grid.at(point).value - exact) <= 0.5 * 0.00215 + 3.0 / 8.0 * voxel * voxel / 0.2);
                CHECK(grid.at(point).value <= exact + 0.01);
                const Vec3 beyond = point.cwiseAbs() - Vec3(0.3, 0.4, 0.5);
                const double ofBox = beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
                if (ofBox < 2.0 * voxel)  // edges of the field lie within a voxel, whose corners are right
                    CHECK(std::abs(boxGrid.at(point).value - ofBox) <= 0.6 * voxel);
            }
    CHECK(engine::memoryOf(grid.bricks()) < 20 * 1024 * 1024);
}

TEST_CASE("Distances from meshes are the same bits for any number of threads", "[meshes]") {
    if (lacksOpenVdb()) return;
    const Mesh torus = turnedMesh({{0.5, 0.0}}, false, 0.2);
    const auto valuesWith = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return scenes::distancesOf(torus, {0.02, 3.0 * 0.02}, "torus.obj").bricks().values;
    };
    CHECK(valuesWith(1) == valuesWith(4));
}

TEST_CASE("A wall thinner than two voxels is refused with its place", "[meshes]") {
    if (lacksOpenVdb()) return;
    const Mesh plate = boxMesh({1.0, 0.03, 1.0});
    CHECK_NOTHROW(scenes::distancesOf(plate, {0.014, 3.0 * 0.014}, "plate.obj"));
    try {
        scenes::distancesOf(plate, {0.02, 3.0 * 0.02}, "plate.obj");
        FAIL("not refused");
    } catch (const scenes::InputError& error) {
        CHECK(error.problems()[0].message.find("the mesh is 0.03 m thin near (") == 0);
    }
    // A wedge whose sides are two triangles each, thin along one edge alone: 0.02 to 0.2 over 2.
    Mesh wedge = boxMesh({2.0, 0.2, 1.0});
    for (Vec3& point : wedge.points)
        if (point.x() > 0.0) point.y() *= 0.1;
    CHECK(!scenes::thinnestPlace(wedge, 0.019).isFound);
    CHECK(scenes::thinnestPlace(wedge, 0.04).place.x() > 0.6);
    CHECK_THROWS_AS(scenes::distancesOf(boxMesh({100.0, 100.0, 100.0}), {0.01, 3.0 * 0.01}, "large.obj"),
                    scenes::InputError);
}

TEST_CASE("A body of a mesh has its volume and center of mass, scaled, placed and turned", "[meshes]") {
    if (lacksAssimp() || lacksOpenVdb()) return;
    const Folder folder;
    Mesh cone = turnedMesh(engine::frustumProfile(0.5, 0.0, 1.0), true, 0.0);
    for (Vec3& point : cone.points) point += Vec3(5.0, 0.0, 0.0);
    folder.write("cone.obj", objOf(cone));
    std::vector<std::string> notes;
    const auto bodyOf = [&](const std::string& keys) {
        const std::string text = scenes_test::kTop +
                                 "[[body]]\nshape = \"mesh\"\nfile = \"cone.obj\"\nspacing = 0.03\n" +
                                 "jitter = 0\nparticle_radius = 0.015\n" + keys;
        const auto scene = scenes::readScene(text, (folder.path / "pile.toml").string(), {});
        notes = scene.meshNotes;
        Vec3 sum = Vec3::Zero();
        for (const Vec3& position : scene.setup.initial.position) sum += position;
        const auto count = static_cast<double>(scene.setup.initial.count());
        return std::pair{count * std::pow(0.03, 3) / std::sqrt(2.0), Vec3(sum / count)};
    };
    const double volume = pi * 0.25 / 3.0;
    const auto asInFile = bodyOf("");
    CHECK(asInFile.first == Approx(volume).epsilon(0.06));
    CHECK((asInFile.second - Vec3(5.0, -0.25, 0.0)).norm() <= 0.015);
    CHECK(notes.size() == 1);
    CHECK(notes[0].find("cone.obj: 192 triangles, watertight, 0.261") == 0);
    const auto placed = bodyOf("center = [0, 1, 0]\nscale = 2\nrotation = [0, 0, 90]\n");
    CHECK(placed.first == Approx(8.0 * volume).epsilon(0.03));
    CHECK((placed.second - Vec3(0.5, 1.0, 0.0)).norm() <= 0.015);
}

TEST_CASE("Normals of meshes are smooth but for sharp edges", "[meshes]") {
    CHECK(scenes::smoothMesh(boxMesh({1.0, 1.0, 1.0})).positions.size() == 24);
    const Mesh ball = turnedMesh({{0.0, 0.0}}, false, 0.5);
    const render::SolidMesh smooth = scenes::smoothMesh(ball);
    CHECK(smooth.positions.size() == ball.points.size());
    for (std::size_t k = 0; k < smooth.positions.size(); ++k)
        CHECK(glm::dot(smooth.normals[k], glm::normalize(smooth.positions[k])) > 0.99F);
}
