// Tests tables within tables, such as the keys of an obstacle's path: what they inherit, and their messages.
#include "tests/catch.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scenes/schema/read_sections.h"
#include "scenes/schema/schema_export.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes::Section;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

/// A valid scene with two obstacles, of which the second has a path. Text that is appended starts in line 20.
const std::string kGate = kBall +
                          "[[obstacle]]\nshape = \"plane\"\n"
                          "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 1, 1]\n"
                          "[[obstacle.key]]\ntime = 0.5\nposition = [0.5, 0.5, 0.5]\n"
                          "[[obstacle.key]]\ntime = 1.5\nrotation = [0, 90, 0]\n"
                          "[[obstacle.key]]\ntime = 2\n";

scenes::Sections sectionsOf(const std::string& text, scenes::ProblemList& problems) {
    return scenes::readSections(scenes::parseDocument(text, problems), problems);
}

const scenes::EffectiveValue* valueAt(const scenes::Scene& scene, const std::string& path) {
    const auto found = std::ranges::find(scene.values, path, &scenes::EffectiveValue::path);
    return found == scene.values.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("a section has the tables that are written within it") {
    scenes::ProblemList problems("pile.toml", {});
    const scenes::Sections sections = sectionsOf(kGate, problems);
    CHECK(problems.empty());
    REQUIRE(sections.obstacles.size() == 2);
    const Section& plane = sections.obstacles[0];
    const Section& gate = sections.obstacles[1];
    CHECK(plane.list("key").empty());
    REQUIRE(gate.list("key").size() == 3);
    CHECK(gate.list("key")[0].path() == "obstacle[1].key[0]");
    CHECK(gate.list("key")[1].number("time") == 1.5);
    CHECK(gate.list("key")[1].position() == scenes::SourcePosition{.line = 15, .column = 1});
    const std::vector<const Section*> all = sections.all();
    const auto at = std::ranges::find(all, &gate);
    REQUIRE(all.end() - at > 3);
    CHECK((at[1] == &gate.list("key")[0] && at[3] == &gate.list("key")[2]));
}

TEST_CASE("a key of a path takes from the key before what it leaves out, but not the time") {
    scenes::ProblemList problems("pile.toml", {});
    const scenes::Sections sections = sectionsOf(kGate, problems);
    const std::vector<Section>& keys = sections.obstacles.at(1).list("key");
    CHECK(!keys.at(0).has("rotation"));
    CHECK(keys.at(1).vector("position") == Vec3(0.5, 0.5, 0.5));
    CHECK(keys.at(1).origin("position") == scenes::ValueOrigin::derived);
    CHECK(keys.at(2).vector("rotation") == Vec3(0.0, 90.0, 0.0));
    CHECK(problemsOf(kGate + "[[obstacle.key]]\nposition = [1, 1, 1]\n") ==
          Lines{"pile.toml:20:1: time is missing, a key of an obstacle needs it (seconds)"});
}

TEST_CASE("the times of a path increase") {
    CHECK(problemsOf(kGate + "[[obstacle.key]]\ntime = 2\n[[obstacle.key]]\ntime = 3\n") ==
          Lines{"pile.toml:21:8: time is 2, must be after that of the key before, 2 (seconds)"});
    CHECK(problemsOf(kBall + "[[camera]]\ntime = 1\n[[camera]]\ntime = 0.5\n") ==
          Lines{"pile.toml:9:8: time is 0.5, must be after that of the camera before, 1 (seconds)"});
}

TEST_CASE("mistakes in tables within tables are found like others") {
    CHECK(problemsOf(kGate + "[[obstacle.key]]\ntime = 3\npositon = [0, 0, 0]\n") ==
          Lines{"pile.toml:22:1: unknown key \"obstacle.key.positon\", did you mean \"position\"?"});
    CHECK(problemsOf(kGate + "[[obstacle.key]]\ntime = -1\nrotation = [0, \"a\", 2e6]\n") ==
          Lines{"pile.toml:21:8: time is -1, must be >= 0 (seconds)",
                "pile.toml:22:16: rotation[1] is \"a\" (a string), must be a number (degrees)",
                "pile.toml:22:21: rotation[2] is 2000000, must be -1000000 to 1000000 (degrees)"});
    CHECK(problemsOf(kGate + "[[obstacle.keys]]\ntime = 3\n") ==
          Lines{"pile.toml:20:1: unknown table \"obstacle.keys\", did you mean \"obstacle.key\"?"});
    CHECK(problemsOf(kGate + "[[obstacle.camera]]\ntime = 3\n") ==
          Lines{"pile.toml:20:1: unknown table \"obstacle.camera\""});
    CHECK(problemsOf(kGate + "[[obstacle]]\nshape = \"plane\"\n[obstacle.key]\ntime = 1\n") ==
          Lines{"pile.toml:22:1: obstacle.key is a table, must be a list of tables: [[obstacle.key]]"});
    CHECK(problemsOf(kGate + "[[obstacle]]\nshape = \"plane\"\nkey = [1]\n") ==
          Lines{"pile.toml:22:8: obstacle[2].key[0] is 1, must be a table"});
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"plane\"\ntime = 1\n") ==
          Lines{"pile.toml:8:1: unknown key \"obstacle.time\", did you mean \"obstacle[].key[].time\"?"});
    CHECK(problemsOf(kBall + "[\"obstacle.key\"]\ntime = 1\n").size() == 1);
}

TEST_CASE("syntax errors in tables within tables do not hide other mistakes") {
    CHECK(problemsOf(kGate + "[[obstacle.key]]\ntime = = 3\n[[obstacle.key]]\ntme = 4\n") ==
          Lines{"pile.toml:21:8: syntax error: value: could not determine value type",
                "pile.toml:23:1: unknown key \"obstacle.key.tme\", did you mean \"time\"?"});
    CHECK(problemsOf(kGate + "[physics]\n[physics]\n[[obstacle.key]]\ntime = 4\n") ==
          Lines{"pile.toml:21:1: table \"physics\" is given twice, first in line 20"});
    CHECK(problemsOf(kGate + "[obstacle]\n[[obstacle.key]]\ntime = 0\n").size() == 1);
}

TEST_CASE("overrides reach tables within tables") {
    const scenes::Scene scene = sceneOf(kGate, {"obstacle[1].key[2].time=2.5", "obstacle.1.key.0.position=[1, 2, 3]"});
    REQUIRE(valueAt(scene, "obstacle[1].key[2].time") != nullptr);
    CHECK(valueAt(scene, "obstacle[1].key[2].time")->toml == "2.5");
    CHECK(valueAt(scene, "obstacle[1].key[1].position")->toml == "[1, 2, 3]");
    const auto problem = [&](const std::string& text) {
        const Lines problems = problemsOf(kGate, {text});
        REQUIRE(problems.size() == 1);
        return problems[0].substr(problems[0].find(": ") + 2);
    };
    CHECK(problem("obstacle[0].key[0].time=1") == "obstacle[0] has no [[obstacle.key]]");
    CHECK(problem("obstacle[1].key[3].time=1") == "obstacle[1] has only 3 [[obstacle.key]], counted from 0");
    CHECK(problem("obstacle[1].key.time=1") == "obstacle[1].key is a list, write obstacle[1].key[0].time");
    CHECK(problem("obstacle.key[0].time=1") == "obstacle is a list, write obstacle[0].key[0].time");
    CHECK(problem("obstacle[1].key[1].tme=1") == "unknown key \"obstacle.key.tme\", did you mean \"time\"?");
    CHECK(problem("obstacle[1].key[1].time=0.5") == "time is 0.5, must be after that of the key before, 0.5 (seconds)");
    CHECK(problem("obstacle[1].kay[1].time=1") ==
          "must be KEY=VALUE, with a key like fps, physics.step or body[0].radius");
}

TEST_CASE("values of tables within tables are listed and hashed") {
    const scenes::Scene scene = sceneOf(kGate);
    const scenes::EffectiveValue* time = valueAt(scene, "obstacle[1].key[1].time");
    REQUIRE(time != nullptr);
    CHECK(time->toml == "1.5");
    CHECK(time->unit == "s");
    CHECK(time->isSimulated);
    const scenes::Scene other = sceneOf(kGate, {"obstacle[1].key[1].time=1.25"});
    CHECK(other.sceneHash != scene.sceneHash);
    CHECK(other.simulationHash != scene.simulationHash);
}

TEST_CASE("tables within tables are part of the schema's exports") {
    CHECK(scenes::schemaText().find("[[obstacle.key]]  # ") != std::string::npos);
    CHECK(scenes::schemaMarkdown().find("## `[[obstacle.key]]`") != std::string::npos);
    const nlohmann::json json = nlohmann::json::parse(scenes::jsonSchema());
    CHECK(!json["properties"].contains("obstacle.key"));
    const nlohmann::json keys = json["definitions"]["obstacle"]["anyOf"][0]["properties"]["key"];
    CHECK(keys["items"]["$ref"] == "#/definitions/obstacle.key");
    CHECK(json["definitions"]["obstacle.key"]["required"] == nlohmann::json::array({"time"}));
    CHECK(!json["definitions"]["body"]["anyOf"][0]["properties"].contains("key"));
}
