// Tests that every scene of the repository loads, and that the paper's scenes have the paper's settings.
#include "tests/catch.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"

using engine::Vec3;

namespace {

const std::string kScenes = GLOBULAR_SOURCE "/scenes/library";

scenes::Scene paperScene(const std::string& name) {
    return scenes::loadScene(kScenes + "/paper/" + name + ".toml", {});
}

std::string textOf(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Table 1 and the published list: b1, b_d, c_r, c_d.
struct Constants {
    std::string name;
    double b1, bd, cr, cd;
};

const std::vector<Constants> kPaper = {
    {"figure-1", .01, 1, 1, 2},     {"figure-2", .01, 1, 1, 2},     {"figure-3", .8, 4, 2, 2},
    {"figure-4", .8, 4, 1, 1},      {"liquid-thin", .005, 1, 1, 2}, {"liquid-thick", .005, 5, 1, 2},
    {"attraction-1", .01, 1, 1, 1}, {"attraction-2", .01, 1, 1, 2}, {"attraction-3", .01, 1, 2, 2},
    {"repulsion-1", .1, 1, 1, 1},   {"repulsion-2", .01, 1, 1, 2},  {"repulsion-3", .1, 4, 2, 2},
    {"issue-high-b1", 2, 1, 2, 2},  {"issue-high-bd", .01, 8, 1, 2}};

}  // namespace

TEST_CASE("every shipped scene loads and has a title") {
    const std::vector<scenes::LibraryEntry> entries = scenes::listScenes(kScenes);
    CHECK(entries.size() >= kPaper.size());
    for (const scenes::LibraryEntry& entry : entries) {
        INFO(entry.name);
        CHECK(!entry.title.empty());
        CHECK_NOTHROW(scenes::loadScene(entry.path, {}));
    }
}

TEST_CASE("the scenes of docs/ load, and the README shows the first of them as it is") {
    const std::filesystem::path docs = std::filesystem::path(GLOBULAR_SOURCE) / "docs";
    int loaded = 0;
    for (const auto& entry : std::filesystem::directory_iterator(docs)) {
        if (entry.path().extension() != ".toml") continue;
        INFO(entry.path());
        CHECK_NOTHROW(scenes::loadScene(entry.path(), {}));
        ++loaded;
    }
    CHECK(loaded >= 2);
    const std::string shown = "```toml\n" + textOf(docs / "first.toml") + "```";
    CHECK(textOf(docs.parent_path() / "README.md").find(shown) != std::string::npos);
}

TEST_CASE("every shipped scene opens with a comment") {
    for (const scenes::LibraryEntry& entry : scenes::listScenes(kScenes)) {
        INFO(entry.name);
        std::string line;
        std::ifstream file(entry.path);
        REQUIRE(std::getline(file, line));
        CHECK(line.substr(0, 2) == "# ");
    }
}

TEST_CASE("no camera of a shipped scene comes close to its target or the ground") {
    int paths = 0;
    for (const scenes::LibraryEntry& entry : scenes::listScenes(kScenes)) {
        INFO(entry.name);
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        if (scene.camera.size() == 1) continue;
        ++paths;
        for (int frame = 0; frame < scenes::frameCount(scene); ++frame) {
            const scenes::CameraPlacement camera = scenes::cameraAt(scene.camera, scenes::frameTime(scene, frame));
            CHECK((camera.eye - camera.target).norm() > 1.0);
            if (scene.look.common.ground) CHECK(camera.eye.y() > scene.look.groundHeight + 0.5);
        }
    }
    CHECK(paths >= 2);
}

TEST_CASE("the paper's scenes have the paper's constants and method") {
    for (const Constants& expected : kPaper) {
        INFO(expected.name);
        const scenes::Scene scene = paperScene(expected.name);
        const engine::Material& material = scene.setup.materials.at(0);
        CHECK(material.repulsion == expected.b1);
        CHECK(material.damping == expected.bd);
        CHECK(material.repulsionReach == expected.cr);
        CHECK(material.dampingReach == expected.cd);
        CHECK(material.radius == 0.15);
        CHECK(material.mass == 1.0);
        CHECK(material.coreFraction == 0.5);
        CHECK(scene.setup.stepper == engine::StepperKind::symplecticEuler);
        CHECK(scene.setup.step == 0.01);
        CHECK(scene.setup.drag == 1.005);
        CHECK(100 % scene.fps.numerator == 0);  // a frame is a whole number of published steps of 0.01 s
        CHECK(scene.look.common.background.top == glm::vec3(0.0F));
        CHECK(scene.size.width % 2 == 0);
        CHECK(scene.size.height % 2 == 0);
    }
}

TEST_CASE("the paper's scenes have its gravity, obstacles and particles") {
    for (const Constants& expected : kPaper) {
        INFO(expected.name);
        const scenes::Scene scene = paperScene(expected.name);
        const bool isSheet = expected.name.find("ion-") != std::string::npos;
        CHECK(scene.setup.gravity == Vec3(0.0, isSheet ? 0.0 : -9.8, 0.0));
        CHECK(scene.setup.emitters.size() == (isSheet ? 0U : 1U));
        std::size_t containers = 0;
        for (const engine::Obstacle& obstacle : scene.setup.obstacles.shapes) {
            if (std::holds_alternative<engine::Container>(obstacle))
                ++containers;
            else
                CHECK(std::get<engine::Sphere>(obstacle).literalRepulsor);
        }
        CHECK(containers == 1);
        CHECK(scene.setup.obstacles.wall == engine::WallLaw::paper);
        for (const engine::Emitter& emitter : scene.setup.emitters) CHECK(emitter.clearance == 0.0);
        for (const Vec3& position : scene.setup.initial.position) CHECK(position.z() == 0.0);
    }
    CHECK(paperScene("attraction-1").setup.initial.count() == 20);
    CHECK(paperScene("repulsion-1").setup.initial.count() == 200);
    CHECK(paperScene("figure-1").setup.emitters.at(0).sites.size() == 5);
    CHECK(paperScene("figure-1").setup.emitters.at(0).pick == engine::Pick::random);
    CHECK(paperScene("liquid-thin").setup.obstacles.shapes.size() == 7);
}

TEST_CASE("the floor line of figure 3 is the last but one row of its picture, as published") {
    const scenes::Scene scene = paperScene("figure-3");
    const scenes::CameraPlacement& camera = scene.camera.at(0).placement;
    // The row of y = -5, counted from the top: half_height corresponds to half the rows.
    const double row = 0.5 * scene.size.height * (1.0 + (camera.target.y() + 5.0) / camera.halfHeight);
    // Published: row 542 of 543. This picture has one row more, half a row at each edge.
    CHECK(row == Approx(543.0).margin(1.0));
}
