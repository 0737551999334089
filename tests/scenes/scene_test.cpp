// Tests the contents of a scene: values, defaults, frames, effective values and the hash.
#include "tests/catch.h"

#include <set>

#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;
using scenes_test::ScratchFolder;

TEST_CASE("a minimal scene has the defaults of the schema") {
    const scenes::Scene scene = sceneOf(kBall);
    CHECK(scene.title == "t");
    CHECK(scene.duration == 2.0);
    CHECK(scene.fps == render::FrameRate{30, 1});
    CHECK(scene.setup.seed == 1);
    CHECK(scene.setup.gravity == Vec3(0.0, -9.8, 0.0));
    CHECK(scene.setup.drag == 0.0);
    CHECK(scene.setup.stepper == engine::StepperKind::automatic);
    CHECK(scene.setup.step == 0.002);
    CHECK(scene.setup.forces == engine::ForceMethod::grid);
    CHECK_FALSE(scene.setup.world);
    CHECK(scene.stillTime == 1.0);
    CHECK(scene.size.width == 1280);
    CHECK(scene.size.height == 720);
    CHECK(scene.sourceName == "pile.toml");
    REQUIRE(scene.setup.materials.size() == 1);
    CHECK(scene.setup.materials[0].name == "liquid");
    CHECK(scene.setup.materials[0].coreFraction == engine::Material{}.coreFraction);
    CHECK(scene.look.common.field.reach == 2.5);
}

TEST_CASE("the keys of a file reach the scene") {
    const scenes::Scene scene = sceneOf(
        "title = \"all\"\ndescription = \"d\"\nduration = 3\nfps = 25\nseed = 9007199254740993\n"
        "[physics]\ngravity = [1, 2, 3]\ndrag = 0.5\nstepper = \"symplectic-euler\"\nstep = 0.01\nforces = "
        "\"reference\"\n"
        "[world]\nminimum = [-9, -2, -9]\n"
        "[[body]]\nshape = \"ball\"\nradius = 1\n[still]\ntime = 3\n[look]\nsize = [640, 480]\nstyle = "
        "\"metaballs\"\n");
    CHECK(scene.description == "d");
    CHECK(scene.fps == render::FrameRate{25, 1});
    // 2^53 + 1 is not a double: a seed keeps all its bits.
    CHECK(scene.setup.seed == 9007199254740993ULL);
    CHECK(scene.setup.gravity == Vec3(1.0, 2.0, 3.0));
    CHECK(scene.setup.drag == 0.5);
    CHECK(scene.setup.stepper == engine::StepperKind::symplecticEuler);
    CHECK(scene.setup.step == 0.01);
    CHECK(scene.setup.forces == engine::ForceMethod::reference);
    REQUIRE(scene.setup.world);
    CHECK(scene.setup.world->low == Vec3(-9.0, -2.0, -9.0));
    CHECK(std::isinf(scene.setup.world->high.y()));
    CHECK(scene.stillTime == 3.0);
    CHECK(scene.size.width == 640);
    CHECK(scene.size.height == 480);
    CHECK(scene.look.common.style == render::Style::metaballs);
}

TEST_CASE("frames are counted by rounding and start at time zero") {
    scenes::Scene scene;
    scene.fps = {30, 1};
    scene.duration = 2.0;
    CHECK(scenes::frameCount(scene) == 60);
    scene.duration = 0.001;
    CHECK(scenes::frameCount(scene) == 1);
    scene.duration = 1.0 / 3.0;
    CHECK(scenes::frameCount(scene) == 10);
    scene.duration = 0.049;
    CHECK(scenes::frameCount(scene) == 1);
    scene.duration = 0.051;
    CHECK(scenes::frameCount(scene) == 2);
    CHECK(scenes::frameTime(scene, 0) == 0.0);
    CHECK(scenes::frameTime(scene, 1) == 1.0 / 30.0);
    CHECK(scenes::frameTime(scene, 45) == 1.5);
}

TEST_CASE("a frame rate may be a fraction, whose frames are never rounded to others") {
    const scenes::Scene scene = sceneOf("fps = \"60000/2002\"\n" + kBall, {"duration=1001"});
    CHECK(scene.fps == render::FrameRate{30000, 1001});
    CHECK(scenes::frameCount(scene) == 30000);
    CHECK(scenes::frameTime(scene, 1) == 1001.0 / 30000.0);
    CHECK(scenes::frameTime(scene, 30000) == 1001.0);
    CHECK(scenes::frameTime(scene, 299999) == 299999.0 * 1001.0 / 30000.0);
    // Equal rates make equal scenes, and the hash of a whole number is that of scenes before there were fractions.
    CHECK(sceneOf("fps = \"30000/1001\"\n" + kBall, {"duration=1001"}).sceneHash == scene.sceneHash);
    CHECK(sceneOf("fps = \"60/2\"\n" + kBall).sceneHash == sceneOf(kBall).sceneHash);
}

TEST_CASE("the effective values list every key that applies once, with its origin") {
    const scenes::Scene scene = sceneOf(kBall + "[material]\nb1 = 0.5\n");
    std::set<std::string> paths;
    for (const scenes::EffectiveValue& value : scene.values) CHECK(paths.insert(value.path).second);
    const auto value = [&](const std::string& path) {
        for (const scenes::EffectiveValue& candidate : scene.values)
            if (candidate.path == path) return candidate;
        FAIL("no value for " << path);
        return scenes::EffectiveValue{};
    };
    CHECK(value("title").toml == "\"t\"");
    CHECK(value("body[0].radius").toml == "0.5");
    CHECK(value("body[0].radius").unit == "m");
    CHECK(value("body[0].radius").origin == scenes::ValueOrigin::given);
    CHECK(value("body[0].spacing").toml == "0.3");
    CHECK(value("body[0].spacing").origin == scenes::ValueOrigin::derived);
    CHECK(value("material.b1").toml == "0.5");
    CHECK(value("material.cd").toml == "2");
    CHECK(value("physics.gravity").toml == "[0, -9.8, 0]");
    CHECK(value("physics.gravity").origin == scenes::ValueOrigin::schemaDefault);
    CHECK(value("still.time").toml == "1");
    CHECK(paths.count("body[0].counts") == 0);
}

TEST_CASE("the hash depends on every value and on nothing else") {
    const std::string hash = sceneOf(kBall).sceneHash;
    CHECK(hash.size() == 16);
    CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(sceneOf("# comment\n" + kBall + "\n\n").sceneHash == hash);
    CHECK(sceneOf(kBall + "center = [0.0, 0, 0]\n[physics]\nstep = 2e-3\n").sceneHash == hash);
    CHECK(sceneOf(kBall, {"duration=2"}).sceneHash == hash);
    // Of two keys that exclude each other, the one in use is part of the hash.
    const std::string ramp = "look.colors=[\"#1f4e9e\", \"#4fb3d9\", \"#f4f1de\"]";
    const std::string mapped = kBall + "[look]\ncolor_by = \"speed\"\ncolor_map = \"lagoon\"\n";
    CHECK(sceneOf(mapped, {ramp}).sceneHash != sceneOf(mapped).sceneHash);
    std::set<std::string> hashes = {hash};
    for (const char* change :
         {"title=u", "duration=2.5", "fps=31", "seed=2", "physics.step=0.003", "physics.gravity=[0,-9.8,1e-9]",
          "body[0].radius=0.6", "material.color=#ffffff", "look.shadows=false", "camera.eye=[0,2,11]", "still.time=0.5",
          "physics.stepper=symplectic-euler"}) {
        INFO(change);
        CHECK(hashes.insert(sceneOf(kBall, {change}).sceneHash).second);
    }
}

TEST_CASE("the hash of the simulation depends on the keys that move particles and on no other") {
    const std::string text = kBall +
                             "[[obstacle]]\nshape = \"box\"\nminimum = [-1, -3, -1]\nmaximum = [1, -2, 1]\n"
                             "[[camera]]\ntime = 0\n[[camera]]\ntime = 1\n[study]\nnumber = 1\nobservable = "
                             "\"momentum-drift\"\nlimit = 1\n";
    const std::string hash = sceneOf(text).simulationHash;
    CHECK(hash.size() == 16);
    CHECK(hash != sceneOf(text).sceneHash);
    for (const char* change :
         {"title=u", "description=d", "duration=2.5", "material.color=#ffffff", "obstacle[0].visible=false",
          "obstacle[0].edges=true", "obstacle[0].color=#ffffff", "camera[1].eye=[0,2,11]", "camera[1].time=3",
          "look.size=[64,64]", "look.style=metaballs", "look.color_by=age", "look.edge_color=#ffffff",
          "overlay.time=true", "still.time=0.5", "study.limit=2"}) {
        INFO(change);
        CHECK(sceneOf(text, {change}).simulationHash == hash);
        CHECK(sceneOf(text, {change}).sceneHash != sceneOf(text).sceneHash);
    }
    std::set<std::string> hashes = {hash};
    for (const char* change :
         {"fps=31", "seed=2", "resolution=1.5", "physics.step=0.003", "physics.error=0.02", "physics.wall=paper",
          "world.minimum=[-9,-9,-9]", "material.bd=3", "material.preset=honey", "body[0].radius=0.6",
          "body[0].velocity=[0,1,0]", "obstacle[0].maximum=[1,-2,1.5]", "obstacle[0].friction=0.5"}) {
        INFO(change);
        CHECK(hashes.insert(sceneOf(text, {change}).simulationHash).second);
    }
}

TEST_CASE("scenes are read from files, and a file that cannot be read is an input error") {
    const ScratchFolder folder;
    const std::string path = folder.write("s.toml", kBall);
    CHECK(scenes::loadScene(path, {}).title == "t");
    CHECK(scenes::loadScene(path, {}).sourceName == path);
    const auto messageOf = [](const std::string& name) {
        try {
            scenes::loadScene(name, {});
        } catch (const scenes::InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string missing = (folder.path / "none.toml").string();
    CHECK(messageOf(missing) == missing + ": cannot be read: No such file or directory");
    CHECK(messageOf(folder.path.string()) == folder.path.string() + ": cannot be read: it is a folder");
}

TEST_CASE("the strip of a scene shows its four quarters, or the given times") {
    CHECK(scenes::stripFrames(sceneOf(kBall)) == std::vector<int>{15, 30, 45, 59});  // 2 s at 30 frames per second
    CHECK(scenes::stripFrames(sceneOf(kBall + "[still]\nstrip = [0.1, 1, 1.9]\n")) == std::vector<int>{3, 30, 57});
    // Two times with the same nearest frame give one picture.
    CHECK(scenes::stripFrames(sceneOf(kBall, {"still.strip=[0.5,0.501,2]"})) == std::vector<int>{15, 59});
}

TEST_CASE("the times of a strip increase and are within the duration") {
    const std::string still = kBall + "[still]\n";
    CHECK(problemsOf(still + "strip = 1\n") == Lines{"pile.toml:7:9: strip is 1, must be a list of numbers (seconds)"});
    CHECK(problemsOf(still + "strip = []\n") ==
          Lines{"pile.toml:7:9: strip is a list of 0, must be a list of numbers (seconds)"});
    CHECK(problemsOf(still + "strip = [0, \"a\", -1]\n") ==
          Lines{"pile.toml:7:13: strip[1] is \"a\" (a string), must be a number (seconds)",
                "pile.toml:7:18: strip[2] is -1, must be >= 0 (seconds)"});
    CHECK(problemsOf(still + "strip = [1, 1, 3]\n") ==
          Lines{"pile.toml:7:9: strip[1] is 1, must be after the time before, 1 (seconds)",
                "pile.toml:7:9: strip[2] is 3, must be at most the duration, 2 (seconds)"});
}
