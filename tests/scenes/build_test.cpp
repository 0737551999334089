// Tests that the tables of a scene become the engine's input: materials, bodies, emitters and obstacles.
#include "tests/catch.h"

#include <cmath>

#include "engine/state/bodies.h"
#include "engine/state/emitter_sites.h"
#include "engine/state/emitters.h"
#include "scenes/particles/particle_file.h"
#include "scenes/text/color.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;
using scenes_test::ScratchFolder;

namespace {

engine::Particles particlesOf(const std::string& body) {
    return sceneOf(kTop + "[[body]]\n" + body).setup.initial;
}

engine::Emitter emitterOf(const std::string& lines) {
    return sceneOf(kTop + "[[emitter]]\n" + lines).setup.emitters.at(0);
}

const scenes::Overrides kPaperWalls{{"physics.wall=paper", "--set"}};

scenes::Scene obstacleScene(const std::string& lines, const scenes::Overrides& overrides = {}) {
    return sceneOf(kBall + "[[obstacle]]\n" + lines, overrides);
}

}  // namespace

TEST_CASE("every preset makes a material with a color") {
    for (const engine::Material& preset : engine::materialPresets()) {
        INFO(preset.name);
        const scenes::Scene scene = sceneOf(kBall + "[material]\npreset = \"" + preset.name + "\"\n");
        CHECK(scene.setup.materials.at(0).name == preset.name);
        CHECK(scene.setup.materials.at(0).repulsion == preset.repulsion);
        CHECK(scene.materialColors.at(0).norm() > 0.0);
    }
}

TEST_CASE("a material has the values of its preset where it gives none of its own") {
    const scenes::Scene scene =
        sceneOf(kBall + "[material]\npreset = \"solid\"\nmass = 2\nbd = 7\ncolor = \"#ff0000\"\ncore = 0.5\n");
    const engine::Material& material = scene.setup.materials.at(0);
    const engine::Material preset = *engine::materialPreset("solid");
    CHECK(material.name == "solid");
    CHECK(material.radius == preset.radius);
    CHECK(material.repulsion == preset.repulsion);
    CHECK(material.repulsionReach == preset.repulsionReach);
    CHECK(material.dampingReach == preset.dampingReach);
    CHECK(material.mass == 2.0);
    CHECK(material.damping == 7.0);
    CHECK(material.coreFraction == 0.5);
    CHECK(scene.materialColors.at(0) == Vec3(1.0, 0.0, 0.0));
}

TEST_CASE("bodies and emitters refer to materials by name, and use the first by default") {
    const scenes::Scene scene = sceneOf(
        kTop +
        "[[material]]\nname = \"a\"\nradius = 0.1\nmass = 1\n[[material]]\nname = \"b\"\nradius = 0.2\nmass = 3\n"
        "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\nmaterial = \"b\"\n"
        "[[body]]\nshape = \"points\"\npositions = [[1, 0, 0]]\n"
        "[[emitter]]\nposition = [2, 0, 0]\nrate = 1\nmaterial = \"b\"\n");
    CHECK(scene.setup.initial.material == std::vector<std::uint32_t>{1, 0});
    CHECK(scene.setup.initial.radius == std::vector<double>{0.2, 0.1});
    CHECK(scene.setup.initial.mass == std::vector<double>{3.0, 1.0});
    CHECK(scene.setup.emitters.at(0).material == 1);
}

TEST_CASE("packed bodies are those of the engine, with a default spacing of two radii") {
    const engine::Particles ball =
        particlesOf("shape = \"ball\"\ncenter = [1, 2, 3]\nradius = 1\nvelocity = [4, 5, 6]\njitter = 0\n");
    CHECK(ball.position == engine::ballPositions(Vec3(1, 2, 3), 1.0, {.spacing = 0.3}));
    CHECK(ball.velocity.at(0) == Vec3(4.0, 5.0, 6.0));
    CHECK(ball.count() > 50);
    const engine::Particles box =
        particlesOf("shape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 2, 1]\nspacing = 0.5\njitter = 0\n");
    CHECK(box.position == engine::boxPositions(Vec3(0, 0, 0), Vec3(1, 2, 1), {.spacing = 0.5}));
    const engine::Particles grid =
        particlesOf("shape = \"grid\"\ncounts = [3, 2, 1]\nparticle_radius = 0.25\nparticle_mass = 9\n");
    CHECK(grid.position == engine::gridPositions(Vec3(0, 0, 0), {3, 2, 1}, {.spacing = 0.5}));
    CHECK(grid.radius.at(5) == 0.25);
    CHECK(grid.mass.at(5) == 9.0);
}

TEST_CASE("balls and boxes have a jitter of their own, grids have none") {
    const engine::Particles ball = particlesOf("shape = \"ball\"\nradius = 1\n");
    const std::vector<Vec3> lattice = engine::ballPositions(Vec3::Zero(), 1.0, {.spacing = 0.3});
    REQUIRE(ball.count() == lattice.size());
    double largest = 0.0;
    for (std::size_t p = 0; p < lattice.size(); ++p)
        largest = std::max(largest, (ball.position[p] - lattice[p]).cwiseAbs().maxCoeff());
    CHECK(largest <= 0.05 * 0.3);
    CHECK(largest > 0.9 * 0.05 * 0.3);
    CHECK(particlesOf("shape = \"ball\"\nradius = 1\njitter = 0\n").position == lattice);
}

TEST_CASE("jitter depends on the seed of the scene and differs between bodies") {
    const std::string body = "[[body]]\nshape = \"grid\"\ncounts = [2, 2, 2]\njitter = 0.2\n";
    const std::string text = kTop + body + body;
    const engine::Particles one = sceneOf(text).setup.initial;
    CHECK(one.position == sceneOf(text).setup.initial.position);
    CHECK(one.position != sceneOf(text, {"seed=2"}).setup.initial.position);
    REQUIRE(one.count() == 16);
    CHECK(one.position[0] != one.position[8]);
    // At most jitter * spacing = 0.2 * 0.3 m in each coordinate.
    CHECK((one.position[0] - Vec3(-0.15, -0.15, -0.15)).cwiseAbs().maxCoeff() <= 0.06);
}

TEST_CASE("points become particles at the given positions") {
    const engine::Particles points = particlesOf(
        "shape = \"points\"\npositions = [[0, 0, 0], [1, 2, 3]]\nvelocities = [[0, 0, 1], [0, 1, 0]]\nvelocity = [5, "
        "0, 0]\n");
    CHECK(points.position == std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 2, 3)});
    CHECK(points.velocity == std::vector<Vec3>{Vec3(5, 0, 1), Vec3(5, 1, 0)});
    CHECK(points.id == std::vector<std::uint32_t>{0, 1});
}

TEST_CASE("a file body is found relative to the scene and restores the state that was written") {
    const ScratchFolder folder;
    engine::Particles state;
    append(state,
           {.position = Vec3(0.1, 0.2, 0.3), .velocity = Vec3(1, 2, 3), .radius = 0.07, .mass = 0.5, .material = 1});
    append(state, {.position = Vec3(4, 5, 6), .velocity = Vec3(-1, 0, 0), .radius = 0.08, .mass = 0.25, .material = 0});
    folder.write("state/drops.ply", scenes::encodeParticles(state));
    const std::string text = kTop +
                             "[[material]]\nname = \"a\"\n[[material]]\nname = \"b\"\n[[body]]\nshape = \"file\"\nfile "
                             "= \"state/drops.ply\"\n";
    const std::string scenePath = folder.write("s.toml", text);
    const engine::Particles read = scenes::loadScene(scenePath, {}).setup.initial;
    CHECK(read.position == state.position);
    CHECK(read.velocity == state.velocity);
    CHECK(read.radius == state.radius);
    CHECK(read.mass == state.mass);
    CHECK(read.material == state.material);

    const engine::Particles changed =
        scenes::loadScene(scenePath, {"body[0].material=b", "body[0].particle_mass=2", "body[0].velocity=[1,0,0]"})
            .setup.initial;
    CHECK(changed.material == std::vector<std::uint32_t>{1, 1});
    CHECK(changed.mass == std::vector<double>{2.0, 2.0});
    CHECK(changed.radius == state.radius);
    CHECK(changed.velocity.at(1) == Vec3(0.0, 0.0, 0.0));

    const std::string before = scenes::loadScene(scenePath, {}).sceneHash;
    state.position[0].x() = 0.1000001;
    folder.write("state/drops.ply", scenes::encodeParticles(state));
    CHECK(scenes::loadScene(scenePath, {}).sceneHash != before);
}

TEST_CASE("problems of a particle file are reported at the key that names it") {
    const ScratchFolder folder;
    const std::string body = kTop + "[[body]]\nshape = \"file\"\nfile = \"none.ply\"\n";
    const std::string scenePath = folder.write("s.toml", body);
    const auto problem = [&] {
        try {
            scenes::loadScene(scenePath, {});
        } catch (const scenes::InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string ply = (folder.path / "none.ply").string();
    CHECK(problem() == scenePath + ":5:8: " + ply + ": cannot be read: No such file or directory");
    folder.write("none.ply", "nonsense");
    CHECK(problem() ==
          scenePath + ":5:8: " + ply +
              ": is no particle file: neither PLY nor VTK PolyData (.vtp), extended XYZ or a LAMMPS dump as text");
    engine::Particles state;
    append(state, {.material = 1});
    folder.write("none.ply", scenes::encodeParticles(state));
    CHECK(problem() == scenePath + ":5:8: " + ply +
                           ": particle 0 is of material 1, the scene has 1 (counted from 0); name one with material");
    folder.write("none.ply", scenes::encodeParticles({}));
    CHECK(problem() == scenePath + ": there is nothing to simulate: the bodies have no particles");
}

TEST_CASE("what is not read of a particle file is a warning at the key that names it") {
    const ScratchFolder folder;
    const std::string scenePath = folder.write("s.toml", kTop + "[[body]]\nshape = \"file\"\nfile = \"points.ply\"\n");
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n";
    folder.write("points.ply", header + "property float z\nend_header\n1 2 3\n");
    CHECK(scenes::loadScene(scenePath, {}).warnings.empty());
    folder.write(
        "points.ply",
        header + "property float z\nproperty uchar red\nelement face 1\nproperty uchar a\nend_header\n1 2 3 4 5\n");
    const scenes::Scene scene = scenes::loadScene(scenePath, {});
    CHECK(scene.setup.initial.position == std::vector<Vec3>{Vec3(1, 2, 3)});
    CHECK(scene.warnings == std::vector<std::string>{scenePath + ":5:8: " + (folder.path / "points.ply").string() +
                                                     ": not read: red, element face"});
}

TEST_CASE("the species of a file are materials where all are called like one") {
    const ScratchFolder folder;
    const std::string body = "[[body]]\nshape = \"file\"\nfile = \"a.xyz\"\n";
    const std::string materials = "[[material]]\nname = \"a\"\n[[material]]\nname = \"b\"\nradius = 0.5\n";
    const std::string scenePath = folder.write("s.toml", kTop + materials + body);
    folder.write("a.xyz", "3\n\nb 0 0 0\na 9 9 9\nb 5 5 5\n");
    const scenes::Scene scene = scenes::loadScene(scenePath, {});
    CHECK(scene.warnings.empty());
    CHECK(scene.setup.initial.material == std::vector<std::uint32_t>{1, 0, 1});
    CHECK(scene.setup.initial.radius.at(0) == 0.5);
    CHECK(scenes::loadScene(scenePath, {"body[0].material=a"}).setup.initial.material ==
          std::vector<std::uint32_t>{0, 0, 0});
    folder.write("a.xyz", "2\n\nb 0 0 0\nHe 9 9 9\n");
    const scenes::Scene other = scenes::loadScene(scenePath, {});
    CHECK(other.setup.initial.material == std::vector<std::uint32_t>{0, 0});
    REQUIRE(other.warnings.size() == 1);
    CHECK(other.warnings[0].find("not read: species (no material is called \"He\")") != std::string::npos);
}

TEST_CASE("emitters have an interval for each schedule") {
    CHECK(emitterOf("position = [1, 2, 3]\ninterval = 0.25\n").interval == 0.25);
    CHECK(emitterOf("position = [1, 2, 3]\nrate = 4\n").interval == 0.25);
    CHECK(emitterOf("positions = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\nrate = 6\n").interval == 0.5);
    CHECK(emitterOf("positions = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]\nrate = 5\npick = \"random\"\n").interval == 0.2);
}

TEST_CASE("the keys of an emitter reach the engine") {
    const engine::Emitter emitter = emitterOf(
        "position = [1, 2, 3]\nrate = 1\nvelocity = [4, 5, 6]\nstart = 0.5\nuntil = 1.5\ncount = 7\npick = "
        "\"random\"\nclearance = 0\njitter = 0.25\n");
    CHECK(emitter.sites == std::vector<Vec3>{Vec3(1, 2, 3)});
    CHECK(emitter.velocity == Vec3(4, 5, 6));
    CHECK(emitter.start == 0.5);
    CHECK(emitter.until == 1.5);
    CHECK(emitter.limit == 7);
    CHECK(emitter.pick == engine::Pick::random);
    CHECK(emitter.clearance == 0.0);
    CHECK(emitter.jitter == 0.25);
    const engine::Emitter plain = emitterOf("position = [0, 0, 0]\nrate = 1\n");
    CHECK(plain.until == engine::Emitter{}.until);
    CHECK(plain.limit == engine::Emitter{}.limit);
    CHECK(plain.pick == engine::Pick::staggered);
    CHECK(plain.jitter == 0.1);
    CHECK(plain.clearance == Approx(1.0 - 0.1 * std::sqrt(2.0)));
    CHECK(plain.spread == 0.0);
    CHECK(plain.speedSpread == 0.0);
    CHECK(plain.cluster == std::vector<Vec3>{Vec3::Zero()});
    CHECK(emitterOf("position = [0, 0, 0]\nrate = 1\njitter = 0\n").clearance == 1.0);
    CHECK(emitterOf("position = [0, 0, 0]\nrate = 1\njitter = 3\n").clearance == 0.8);
    CHECK(emitterOf("position = [0, 0, 0]\nrate = 1\npick = \"all\"\n").pick == engine::Pick::all);
}

TEST_CASE("a disc is filled with points of emission perpendicular to its direction") {
    const std::string disc = "shape = \"disc\"\nposition = [0, 1, 0]\nradius = 0.5\nrate = 10\n";
    const engine::Emitter along = emitterOf(disc + "velocity = [0, -3, 0]\n");
    CHECK(along.sites == engine::takingTurns(engine::discSites(Vec3(0, 1, 0), Vec3(0, -1, 0), 0.5, 0.3)));
    CHECK(along.interval == Approx(static_cast<double>(along.sites.size()) / 10.0));
    const engine::Emitter tilted = emitterOf(disc + "velocity = [0, -3, 0]\ndirection = [2, 0, 0]\nspacing = 0.25\n");
    CHECK(tilted.sites == engine::takingTurns(engine::discSites(Vec3(0, 1, 0), Vec3(1, 0, 0), 0.5, 0.25)));
    CHECK(emitterOf(disc + "velocity = [0, -3, 0]\npick = \"all\"\n").sites ==
          engine::discSites(Vec3(0, 1, 0), Vec3(0, -1, 0), 0.5, 0.3));
}

TEST_CASE("rings, boxes and lines are filled with points of emission") {
    const std::string all = "velocity = [0, -3, 0]\npick = \"all\"\nrate = 10\nposition = [1, 2, 3]\n";
    CHECK(emitterOf(all + "shape = \"ring\"\nradius = 0.5\n").sites ==
          engine::ringSites(Vec3(1, 2, 3), Vec3(0, -1, 0), 0.5, 0.3));
    CHECK(emitterOf(all + "shape = \"box\"\nsize = [2, 0, 1]\nspacing = 0.25\n").sites ==
          engine::boxSites(Vec3(1, 2, 3), Vec3(2, 0, 1), 0.25));
    CHECK(emitterOf(all + "shape = \"line\"\nend = [1, 2, 5]\n").sites ==
          engine::lineSites(Vec3(1, 2, 3), Vec3(1, 2, 5), 0.3));
}

TEST_CASE("spread and clusters reach the engine") {
    const engine::Emitter emitter = emitterOf(
        "shape = \"box\"\nposition = [0, 9, 0]\nsize = [4, 0, 4]\nvelocity = [0, -3, 0]\nrate = 130\ncluster = 13\n"
        "spread = 60\nspeed_spread = 0.25\n");
    CHECK(emitter.spread == Approx(0.5));
    CHECK(emitter.speedSpread == 0.25);
    CHECK(emitter.cluster == engine::clusterPositions(13, 0.3));
    CHECK(emitter.interval == Approx(static_cast<double>(emitter.sites.size()) / 10.0));
    // A drop of 13 is about a particle and its twelve neighbors: 0.9 m across.
    for (std::size_t a = 0; a < emitter.sites.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) CHECK((emitter.sites[a] - emitter.sites[b]).norm() > 0.85);
}

TEST_CASE("an emitter without a rate emits particles that touch") {
    const std::string disc = "shape = \"disc\"\nposition = [0, 9, 0]\nradius = 0.5\nvelocity = [0, -3, 0]\n";
    const engine::Emitter dense = emitterOf(disc);
    // 3 t + 4.9 t^2 = 0.3, the diameter; an interval is a thousandth longer.
    const double clearing = (-3.0 + std::sqrt(9.0 + 4.0 * 4.9 * 0.3)) / 9.8;
    CHECK(dense.interval > clearing);
    CHECK(dense.interval < 1.002 * clearing);
    CHECK(dense.clearance < 0.9);  // so that jitter leaves room
    const engine::Emitter crowded = emitterOf(disc + "spacing = 0.15\n");
    CHECK(crowded.interval > 2.0 * clearing);  // four times the points on the same area
    CHECK(emitterOf(disc + "pick = \"all\"\njitter = 0\n").interval == dense.interval);
}

TEST_CASE("obstacles become shapes of the engine") {
    const auto plane = std::get<engine::Plane>(
        obstacleScene("shape = \"plane\"\npoint = [0, 1, 0]\nnormal = [0, 3, 4]\n").setup.obstacles.shapes.at(0));
    CHECK(plane.point == Vec3(0, 1, 0));
    CHECK((plane.normal - Vec3(0.0, 0.6, 0.8)).norm() < 1e-15);  // two roundings of numbers below 1
    const auto box = std::get<engine::Box>(
        obstacleScene("shape = \"box\"\nminimum = [0, 1, 2]\nmaximum = [3, 4, 5]\n").setup.obstacles.shapes.at(0));
    CHECK(box.minimum == Vec3(0, 1, 2));
    CHECK(box.maximum == Vec3(3, 4, 5));
    const auto container = std::get<engine::Container>(
        obstacleScene("shape = \"container\"\ncenter = [1, 0, 0]\nsize = [2, 4, 6]\n").setup.obstacles.shapes.at(0));
    CHECK(container.minimum == Vec3(0, -2, -3));
    CHECK(container.maximum == Vec3(2, 2, 3));
    const auto sphere = std::get<engine::Sphere>(
        obstacleScene("shape = \"sphere\"\ncenter = [1, 2, 3]\nradius = 0.75\nrepulsor = \"literal\"\n", kPaperWalls)
            .setup.obstacles.shapes.at(0));
    CHECK(sphere.center == Vec3(1, 2, 3));
    CHECK(sphere.radius == 0.75);
    CHECK(sphere.literalRepulsor);
    CHECK(!std::get<engine::Sphere>(
               obstacleScene("shape = \"sphere\"\ncenter = [1, 2, 3]\nradius = 1\n").setup.obstacles.shapes.at(0))
               .literalRepulsor);
}

TEST_CASE("obstacles answer as scaled walls unless the scene asks for the paper's") {
    const std::string plane = "shape = \"plane\"\n";
    const engine::Obstacles plain = obstacleScene(plane).setup.obstacles;
    CHECK(plain.wall == engine::WallLaw::scaled);
    CHECK(plain.gravity == 9.8);
    CHECK(plain.surfaces.at(0).rebound.isDampedByMaterial);
    CHECK(!plain.surfaces.at(0).friction.has_value());
    CHECK(plain.surfaces.at(0).adhesion == 0.0);
    CHECK(plain.surfaces.at(0).wetting == 0.0);
    // 1 + cos 60 degrees, whose sine and cosine are right to 4e-16.
    CHECK(obstacleScene(plane + "contact_angle = 60\n").setup.obstacles.surfaces.at(0).wetting ==
          Approx(1.5).epsilon(1e-15));
    const engine::Obstacles given =
        obstacleScene(plane + "restitution = 0.7\nfriction = 0.3\nadhesion = 20\n").setup.obstacles;
    CHECK(given.surfaces.at(0).rebound.restitution == 0.7);
    CHECK(!given.surfaces.at(0).rebound.isDampedByMaterial);
    CHECK(given.surfaces.at(0).friction == 0.3);
    CHECK(given.surfaces.at(0).adhesion == 20.0);
    CHECK(obstacleScene(plane, kPaperWalls).setup.obstacles.wall == engine::WallLaw::paper);
}

TEST_CASE("keys of one wall law are refused under the other") {
    const std::string plane = "[[obstacle]]\nshape = \"plane\"\nrestitution = 0.7\n";
    CHECK(scenes_test::problemsOf(scenes_test::kBall + plane, kPaperWalls) ==
          scenes_test::Lines{
              "pile.toml:8:15: the paper's walls have no restitution; leave out physics.wall = \"paper\""});
    const std::string sphere =
        "[[obstacle]]\nshape = \"sphere\"\ncenter = [0, -9, 0]\nradius = 1\nrepulsor = \"literal\"\n";
    CHECK(scenes_test::problemsOf(scenes_test::kBall + sphere) ==
          scenes_test::Lines{"pile.toml:10:12: \"literal\" is the repulsor of the paper's walls; it needs "
                             "physics.wall = \"paper\""});
    CHECK(scenes_test::problemsOf(scenes_test::kBall + sphere, kPaperWalls).empty());
}

TEST_CASE("the keys of an obstacle determine how it is drawn") {
    const auto drawn = [](const std::string& text) { return scenes_test::viewAt(obstacleScene(text), 0.0); };
    CHECK(drawn("shape = \"plane\"\n").boxObstacles.empty());
    const std::string box = "minimum = [0, 0, 0]\nmaximum = [1, 1, 1]\n";
    CHECK(drawn("shape = \"box\"\n" + box).edges.empty());
    CHECK(drawn("shape = \"container\"\n" + box).edges.at(0).color == glm::vec3(1.0F, 0.9F, 0.0F));
    CHECK(drawn("shape = \"box\"\nedges = true\ncolor = [0.1, 0.2, 0.3]\n" + box).boxObstacles.at(0).color ==
          glm::vec3(0.1F, 0.2F, 0.3F));
    CHECK(drawn("shape = \"box\"\nvisible = false\n" + box).boxObstacles.empty());
}
