// Tests every kind of mistake that a scene can have beyond its syntax, with the exact position and text of the message.
#include "tests/catch.h"

#include <cmath>

#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

TEST_CASE("a scene without mistakes has no problems") {
    CHECK(problemsOf(kBall) == Lines{});
}

TEST_CASE("unknown keys and tables are named, with the nearest known name") {
    CHECK(problemsOf(kBall + "[physics]\ngravty = [0, 0, 0]\n") ==
          Lines{"pile.toml:7:1: unknown key \"physics.gravty\", did you mean \"gravity\"?"});
    CHECK(problemsOf(kBall + "[physics]\n  quux = 1\n") == Lines{"pile.toml:7:3: unknown key \"physics.quux\""});
    CHECK(problemsOf("tittle = 3\n" + kBall) ==
          Lines{"pile.toml:1:1: unknown key \"tittle\", did you mean \"title\"?"});
    CHECK(problemsOf(kBall + "[phisics]\nstep = 1\n") ==
          Lines{"pile.toml:6:1: unknown table \"phisics\", did you mean \"physics\"?"});
    CHECK(problemsOf(kBall + "[quux]\n") == Lines{"pile.toml:6:1: unknown table \"quux\""});
}

TEST_CASE("for a key in the wrong table the right one is suggested") {
    CHECK(problemsOf(kBall + "[physics]\nfps = 30\n") ==
          Lines{"pile.toml:7:1: unknown key \"physics.fps\": it belongs above the first table"});
    CHECK(problemsOf("gravity = [0, 0, 0]\n" + kBall) ==
          Lines{"pile.toml:1:1: unknown key \"gravity\", did you mean \"physics.gravity\"?"});
}

TEST_CASE("a mistyped key is not reported as missing, too") {
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"ball\"\nraduis = 1\n") ==
          Lines{"pile.toml:5:1: unknown key \"body.raduis\", did you mean \"radius\"?"});
    CHECK(problemsOf(kTop + "[[emitter]]\npositon = [0, 0, 0]\ninterval = 1\n") ==
          Lines{"pile.toml:4:1: unknown key \"emitter.positon\", did you mean \"position\"?"});
    CHECK(problemsOf("titel = \"t\"\nduration = 2\n[[body]]\nshape = \"ball\"\nradius = 1\n") ==
          Lines{"pile.toml:1:1: unknown key \"titel\", did you mean \"title\"?"});
}

TEST_CASE("the message for a wrong type names the value and the expected type") {
    const auto physics = [](const std::string& line) { return problemsOf(kBall + "[physics]\n" + line + "\n"); };
    CHECK(physics("step = \"fast\"") ==
          Lines{"pile.toml:7:8: step is \"fast\" (a string), must be a number (seconds)"});
    CHECK(physics("step = true") == Lines{"pile.toml:7:8: step is true, must be a number (seconds)"});
    CHECK(physics("step = [1]") == Lines{"pile.toml:7:8: step is a list of 1, must be a number (seconds)"});
    CHECK(physics("step = {}") == Lines{"pile.toml:7:8: step is a table, must be a number (seconds)"});
    CHECK(physics("step = 1979-05-27") == Lines{"pile.toml:7:8: step is a date or time, must be a number (seconds)"});
    CHECK(physics("gravity = 9.8") == Lines{"pile.toml:7:11: gravity is 9.8, must be three numbers [x, y, z] (m/s^2)"});
    CHECK(physics("gravity = [0, 1]") ==
          Lines{"pile.toml:7:11: gravity is a list of 2, must be three numbers [x, y, z] (m/s^2)"});
    CHECK(physics("gravity = [0, \"g\", 0]") ==
          Lines{"pile.toml:7:15: gravity[1] is \"g\" (a string), must be a number (m/s^2)"});
    CHECK(physics("stepper = 4") ==
          Lines{"pile.toml:7:11: stepper is 4, must be \"symplectic-euler\", \"velocity-verlet\", "
                "\"leapfrog\", \"implicit-damping\", \"linearly-implicit\" or \"auto\""});
    CHECK(
        problemsOf("fps = 29.97\n" + kBall) ==
        Lines{"pile.toml:1:7: fps is 29.97, must be a whole number or a fraction such as \"30000/1001\" (per second)"});
    for (const std::string wrong : {"30", "30/0", "30/-1", "a/b", "30/1.001", "1000001/1000001", "30000/1001/1"})
        CHECK(problemsOf("fps = \"" + wrong + "\"\n" + kBall) ==
              Lines{"pile.toml:1:7: fps is \"" + wrong +
                    "\" (a string), must be a whole number or a fraction such as \"30000/1001\" (per second)"});
    CHECK(problemsOf("description = 1\n" + kBall) == Lines{"pile.toml:1:15: description is 1, must be a string"});
    CHECK(problemsOf(kBall + "[look]\nshadows = 1\n") == Lines{"pile.toml:7:11: shadows is 1, must be true or false"});
    CHECK(problemsOf(kBall + "[look]\nsize = [640.5, 480]\n") ==
          Lines{"pile.toml:7:9: size[0] is 640.5, must be a whole number (pixels)"});
    CHECK(problemsOf(kBall + "[look]\nground_color = \"red\"\n") ==
          Lines{"pile.toml:7:16: ground_color is \"red\" (a string), must be \"#rrggbb\" or [r, g, b]"});
}

TEST_CASE("numbers out of range are rejected, with bounds and unit") {
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"ball\"\nradius = -0.2\n") ==
          Lines{"pile.toml:5:10: radius is -0.2, must be > 0 and <= 100000000 (meters)"});
    CHECK(problemsOf("fps = 241\n" + kBall) == Lines{"pile.toml:1:7: fps is 241, must be 1 to 240 (per second)"});
    CHECK(problemsOf("fps = 0\n" + kBall) == Lines{"pile.toml:1:7: fps is 0, must be 1 to 240 (per second)"});
    CHECK(problemsOf("fps = 4294967326\n" + kBall) ==
          Lines{"pile.toml:1:7: fps is 4294967326, must be 1 to 240 (per second)"});
    CHECK(problemsOf("fps = \"1001/2\"\n" + kBall) ==
          Lines{"pile.toml:1:7: fps is \"1001/2\" (a string), must be 1 to 240 (per second)"});
    CHECK(problemsOf(kBall + "[material]\ncr = 0.9\n") == Lines{"pile.toml:7:6: cr is 0.9, must be >= 1"});
    CHECK(problemsOf(kBall + "[material]\ncore = 1\n") == Lines{"pile.toml:7:8: core is 1, must be > 0 and < 1"});
    CHECK(problemsOf(kBall + "[look]\nsize = [15, 8193]\n") ==
          Lines{"pile.toml:7:9: size[0] is 15, must be 16 to 8192 (pixels)",
                "pile.toml:7:13: size[1] is 8193, must be 16 to 8192 (pixels)"});
    CHECK(problemsOf(kBall + "[look]\nlight_color = [-1, 0, 2]\n") ==
          Lines{"pile.toml:7:16: light_color[0] is -1, must be 0 to 100"});
}

TEST_CASE("bounds are accepted unless they are excluded") {
    CHECK(problemsOf("fps = 240\n" + kBall) == Lines{});
    CHECK(problemsOf("fps = 1\n" + kBall) == Lines{});
    CHECK(problemsOf(kBall + "[material]\ncr = 1\n") == Lines{});
    CHECK(problemsOf(kBall + "[look]\nsize = [16, 8192]\n") == Lines{});
}

TEST_CASE("the maximum of a world has to be above its minimum") {
    CHECK(problemsOf(kBall + "[world]\nminimum = [0, 1, 0]\nmaximum = [2, 1, -1]\n") ==
          Lines{"pile.toml:8:11: maximum[1] is 1, must be above the minimum 1 (meters)",
                "pile.toml:8:11: maximum[2] is -1, must be above the minimum 0 (meters)"});
    CHECK(problemsOf(kBall + "[world]\nmaximum = [9, 9, 9]\n") == Lines{});
    CHECK(problemsOf(kBall + "[world]\nmaximum = [9, 9, 2e8]\n") ==
          Lines{"pile.toml:7:18: maximum[2] is 200000000, must be -100000000 to 100000000 (meters)"});
}

TEST_CASE("no particle may start outside the world") {
    CHECK(problemsOf(kTop + "[world]\nmaximum = [9, 9, 9]\n[[body]]\nshape = \"points\"\npositions = [[1, 10, 1]]\n") ==
          Lines{"pile.toml:3:1: a body's particle at [1, 10, 1] is outside the world"});
    CHECK(problemsOf(kTop + "[world]\nmaximum = [9, 9, 9]\n[[emitter]]\nposition = [1, 1, 9.5]\ninterval = 1\n") ==
          Lines{"pile.toml:3:1: an emitter's point of emission at [1, 1, 9.5] is outside the world"});
}

TEST_CASE("no particle may start further out than can be simulated") {
    const auto at = [](const std::string& center) {
        return problemsOf(kTop + "[[body]]\nshape = \"ball\"\nradius = 0.2\njitter = 0\ncenter = [" + center +
                          ", 0, 0]\n");
    };
    CHECK(at("99999998") == Lines{});
    const Lines problems = at("100000000");
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].find("pile.toml:4:9: a particle would be at (1e+08, 0, 0), must be less than 1e+08 m") == 0);
    CHECK(problemsOf(kTop + "[[emitter]]\nposition = [0, -1e8, 0]\ninterval = 1\n") ==
          Lines{"pile.toml:4:12: a particle would be at (0, -1e+08, 0), must be less than 1e+08 m from the origin"});
}

TEST_CASE("radii and masses of particles have bounds") {
    CHECK(problemsOf(kBall + "[material]\nradius = 1e39\n") ==
          Lines{"pile.toml:7:10: radius is 1e+39, must be 1e-09 to 10000000 (meters)"});
    CHECK(problemsOf(kBall + "[material]\nradius = 1e-30\n") ==
          Lines{"pile.toml:7:10: radius is 1e-30, must be 1e-09 to 10000000 (meters)"});
    CHECK(problemsOf(kBall + "particle_mass = 0\n") ==
          Lines{"pile.toml:6:17: particle_mass is 0, must be 1e-30 to 1e+30 (kilograms)"});
}

TEST_CASE("numbers that are not finite are rejected") {
    CHECK(problemsOf(kBall + "[physics]\ngravity = [0, -inf, nan]\n") ==
          Lines{"pile.toml:7:15: gravity[1] is -inf, must be finite (m/s^2)",
                "pile.toml:7:21: gravity[2] is nan, must be finite (m/s^2)"});
    CHECK(problemsOf(kBall + "[physics]\ndrag = nan\n") ==
          Lines{"pile.toml:7:8: drag is nan, must be finite (per second)"});
}

TEST_CASE("the message for a wrong choice lists all, and suggests the nearest") {
    CHECK(problemsOf(kBall + "[material]\npreset = \"liqid\"\n") ==
          Lines{"pile.toml:7:10: preset is \"liqid\", must be \"liquid\", \"solid\", \"powder\", \"fountain\", "
                "\"honey\", \"jam\", \"oil\", \"lava\", \"mud\", \"molten-metal\" or \"sand\", "
                "did you mean \"liquid\"?"});
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"torus\"\n") ==
          Lines{"pile.toml:4:9: shape is \"torus\", must be \"box\", \"ball\", \"grid\", \"cylinder\", "
                "\"cone\", \"frustum\", \"capsule\", \"shell\", \"revolution\", \"mesh\", \"text\", \"image\", "
                "\"points\" or \"file\""});
}

TEST_CASE("missing keys are reported at the table that needs them") {
    CHECK(problemsOf("[[body]]\nshape = \"ball\"\nradius = 1\n") ==
          Lines{"pile.toml: title is missing, a scene needs it",
                "pile.toml: duration is missing, a scene needs it (seconds)"});
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"ball\"\n") ==
          Lines{"pile.toml:3:1: radius is missing, a body of shape \"ball\" needs it (meters)"});
    CHECK(problemsOf(kTop + "[[body]]\n") == Lines{"pile.toml:3:1: shape is missing, a body needs it"});
    CHECK(problemsOf(kTop + "[[emitter]]\n") ==
          Lines{"pile.toml:3:1: position is missing, an emitter needs it (meters)"});
    const std::string still = kTop + "[physics]\ngravity = [0, 0, 0]\n[[emitter]]\nposition = [0, 0, 0]\n";
    CHECK(problemsOf(still) ==
          Lines{"pile.toml:5:1: rate is missing, an emitter whose particles do not move away needs it (per second)"});
    CHECK(problemsOf(still + "velocity = [0, 1, 0]\nclearance = 0\n") ==
          Lines{"pile.toml:5:1: rate is missing, an emitter without clearance needs it (per second)"});
    CHECK(problemsOf(still + "velocity = [0, 1, 0]\n").empty());
    CHECK(problemsOf(still + "rate = 1\ncluster = 9\ncount = 8\n") ==
          Lines{"pile.toml:9:9: count is 8, must be at least that of one cluster, 9"});
    CHECK(problemsOf(still + "rate = 1\nshape = \"line\"\nend = [1e6, 0, 0]\n") ==
          Lines{"pile.toml:5:1: the line would have about 3.3e+06 points of emission, at most 2000000 are allowed; "
                "--limit particles=N allows more"});
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"sphere\"\n") ==
          Lines{"pile.toml:6:1: radius is missing, an obstacle of shape \"sphere\" needs it (meters)",
                "pile.toml:6:1: center is missing, an obstacle of shape \"sphere\" needs it (meters)"});
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\n").size() == 1);
}

TEST_CASE("keys that do not apply to the shape are rejected") {
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 1, 1]\nradius = 1\n") ==
          Lines{"pile.toml:7:1: radius does not apply to shape \"box\", only to ball, cylinder, cone, "
                "frustum, capsule, shell"});
    CHECK(problemsOf(kBall + "[camera]\nhalf_height = 3\n") ==
          Lines{"pile.toml:7:1: half_height does not apply to projection \"perspective\", only to orthographic"});
    CHECK(problemsOf(kBall + "[look]\ncolors = [\"#000000\"]\n") ==
          Lines{"pile.toml:7:1: colors does not apply to color_by \"material\", only to speed, age, temperature"});
}

TEST_CASE("keys that exclude each other are reported at the later one") {
    const std::string emitter = kTop + "[[emitter]]\nposition = [0, 0, 0]\n";
    CHECK(problemsOf(emitter + "interval = 1\nrate = 2\n") ==
          Lines{"pile.toml:6:8: interval and rate exclude each other, give one"});
    CHECK(problemsOf(emitter + "rate = 2\ninterval = 1\n") ==
          Lines{"pile.toml:6:12: interval and rate exclude each other, give one"});
    CHECK(problemsOf(emitter + "positions = [[0, 0, 0]]\nrate = 2\n") ==
          Lines{"pile.toml:5:13: position and positions exclude each other, give one"});
    CHECK(problemsOf(emitter + "rate = 2\nstart = 1\nuntil = 1\n") ==
          Lines{"pile.toml:7:9: until is 1, must be after start, 1 (seconds)"});
    CHECK(problemsOf(kBall +
                     "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 1, 1]\nsize = [1, 1, 1]\n") ==
          Lines{"pile.toml:10:8: give either minimum and maximum, or center and size"});
    CHECK(problemsOf(kTop +
                     "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0], [1, 0, 0]]\nvelocities = [[0, 0, 0]]\n") ==
          Lines{"pile.toml:6:14: velocities has 1 entries, must have 2 like positions"});
    CHECK(problemsOf(kBall + "[still]\ntime = 2.5\n") ==
          Lines{"pile.toml:7:8: time is 2.5, must be at most the duration, 2 (seconds)"});
}

TEST_CASE("a written key has its own position, not that of a mistyped one") {
    CHECK(problemsOf(kTop + "[[emitter]]\nposition = [0, 0, 0]\nintervall = 1\nrate = 2\ninterval = 1\n") ==
          Lines{"pile.toml:5:1: unknown key \"emitter.intervall\", did you mean \"interval\"?",
                "pile.toml:7:12: interval and rate exclude each other, give one"});
}

TEST_CASE("corners, directions and cameras are checked") {
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, 0, 1]\n") ==
          Lines{"pile.toml:9:11: maximum[1] is 0, must be above the minimum 0 (meters)"});
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"box\"\nminimum = [0, 0, 0]\nmaximum = [1, -1, 1]\n") ==
          Lines{"pile.toml:6:11: maximum[1] is -1, must be at least the minimum 0 (meters)"});
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"plane\"\nnormal = [0, 0, 0]\n") ==
          Lines{"pile.toml:8:10: normal is [0, 0, 0], must not be zero"});
    CHECK(problemsOf(kBall + "[camera]\neye = [0, 0, 0]\n") ==
          Lines{"pile.toml:6:1: target is where eye is, must be another point"});
    CHECK(problemsOf(kBall + "[camera]\neye = [0, 9, 0]\n") ==
          Lines{"pile.toml:6:1: up lies along the direction of view, must point across it"});
    CHECK(problemsOf(kBall + "[look]\nlight_direction = [0, 0, 0]\n") ==
          Lines{"pile.toml:7:19: light_direction is [0, 0, 0], must not be zero"});
    CHECK(problemsOf(kTop + "[[emitter]]\nshape = \"disc\"\nposition = [0, 0, 0]\nradius = 1\nrate = 1\n") ==
          Lines{"pile.toml:3:1: direction is missing, a disc whose velocity is zero needs it"});
    CHECK(problemsOf(kTop + "[[emitter]]\nshape = \"ring\"\nposition = [0, 0, 0]\nradius = 1\nrate = 1\n") ==
          Lines{"pile.toml:3:1: direction is missing, a ring whose velocity is zero needs it"});
    CHECK(
        problemsOf(kBall + "[look]\ncolor_by = \"speed\"\ncolor_range = [2, 1]\n") ==
        Lines{"pile.toml:8:15: color_range is [2, 1], must be two numbers [low, high], low below high (m/s, s or K)"});
}

TEST_CASE("materials have to be defined exactly once") {
    const std::string two = "[[material]]\nname = \"wax\"\n[[material]]\nname = \"sand\"\n";
    CHECK(problemsOf(kTop + two + "[[body]]\nshape = \"ball\"\nradius = 1\nmaterial = \"snad\"\n") ==
          Lines{"pile.toml:10:12: material \"snad\" is not defined, did you mean \"sand\"?"});
    CHECK(problemsOf(kTop + two + "[[body]]\nshape = \"ball\"\nradius = 1\nmaterial = \"mercury\"\n") ==
          Lines{"pile.toml:10:12: material \"mercury\" is not defined (defined: wax, sand)"});
    CHECK(problemsOf(kBall + "[[material]]\nname = \"wax\"\n[[material]]\nname = \"wax\"\n") ==
          Lines{"pile.toml:9:8: there are two materials with the name \"wax\""});
}

TEST_CASE("tables in the wrong form are rejected") {
    CHECK(problemsOf(kTop + "[body]\nshape = \"ball\"\nradius = 1\n") ==
          Lines{"pile.toml:3:1: body is a table, must be a list of tables: [[body]]"});
    CHECK(problemsOf(kBall + "[[physics]]\nstep = 0.1\n") ==
          Lines{"pile.toml:6:1: physics is a list of 1, must be one table: [physics]"});
    CHECK(problemsOf("physics = 3\n" + kBall) == Lines{"pile.toml:1:11: physics is 3, must be one table: [physics]"});
    CHECK(problemsOf("body = [1]\n" + kTop) == Lines{"pile.toml:1:9: body[0] is 1, must be a table"});
}

TEST_CASE("a scene without particles is rejected") {
    CHECK(problemsOf(kTop) == Lines{"pile.toml: there is nothing to simulate: give a [[body]] or an [[emitter]]"});
}

const std::string kParticleLimit = " are allowed; --limit particles=N allows more";

TEST_CASE("bodies and emitters that are too large are rejected before memory is allocated") {
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"ball\"\nradius = 1e8\n") ==
          Lines{"pile.toml:4:9: the body would have about 4.2e+26 particles, at most 2000000 are allowed; --limit "
                "particles=N allows more"});
    CHECK(problemsOf(kTop + "[[body]]\nshape = \"grid\"\ncounts = [1000, 1000, 1000]\n") ==
          Lines{"pile.toml:4:9: the body would have about 1e+09 particles, at most 2000000 are allowed; --limit "
                "particles=N allows more"});
    CHECK(problemsOf(kTop + "[[emitter]]\nposition = [0, 0, 0]\nrate = 1e9\n") ==
          Lines{"pile.toml:5:8: the emitter would emit about 2e+09 particles, at most 2000000 are allowed; "
                "--limit particles=N allows more"});
    CHECK(
        problemsOf(
            kTop +
            "[[emitter]]\nshape = \"disc\"\nposition = [0, 0, 0]\nradius = 1e6\nrate = 1\nvelocity = [0, 1, 0]\n") ==
        Lines{
            "pile.toml:3:1: the disc would have about 4.4e+13 points of emission, at most 2000000 are allowed; --limit "
            "particles=N allows more"});
}

TEST_CASE("the limit applies to the particles of all bodies together") {
    const std::string body = "[[body]]\nshape = \"grid\"\ncounts = [100, 100, 120]\n";
    CHECK(problemsOf(kTop + body + "[[emitter]]\nposition = [0, 0, 0]\nrate = 1000\n") == Lines{});
    CHECK(
        problemsOf(kTop + body + body) ==
        Lines{"pile.toml:7:9: the body would have about 1.2e+06 particles, 2.4e+06 with those before, at most 2000000" +
              kParticleLimit});
}

TEST_CASE("animations and pictures that are too large are rejected, unless a limit is raised") {
    const std::string body = "[[body]]\nshape = \"ball\"\nradius = 0.5\n";
    const std::string lengthy = "title = \"t\"\nduration = 5000.0\n" + body;
    const std::string large = kTop + body + "[look]\nsize = [8000, 8000]\n";
    CHECK(problemsOf(lengthy) ==
          Lines{"pile.toml:2:12: the animation would have about 150000 frames, at most 100000 are "
                "allowed; --limit frames=N allows more"});
    REQUIRE(problemsOf(large).size() == 1);
    CHECK(problemsOf(large).front().find("a picture would have about 6.4e+07 pixels, at most 8294400 are allowed; "
                                         "--limit pixels=N allows more") != std::string::npos);
    CHECK_NOTHROW(scenes::readScene(lengthy, "pile.toml", {}, {.frames = 150000.0}));
    CHECK_NOTHROW(scenes::readScene(large, "pile.toml", {}, {.pixels = 64e6}));
}

TEST_CASE("ten different mistakes are ten problems, in order of position") {
    const std::string text =
        "title = 3\n"      // 1 type
        "duration = -1\n"  // 2 range
        "[physics]\n"
        "gravty = [0, -9.8, 0]\n"           // 3 unknown key
        "drag = nan\n"                      // 4 not finite
        "stepper = \"symplectic-eular\"\n"  // 5 choice
        "step = 0..1\n"                     // 6 syntax
        "step = 0.1\n"                      // 7 duplicate
        "[[body]]\n"                        // 8 missing key
        "shape = \"ball\"\n"
        "material = \"sand\"\n"  // 9 undefined material
        "[camra]\n"              // 10 unknown table
        "eye = [0, 0, 0]\n";
    const Lines expected = {
        "pile.toml:1:9: title is 3, must be a string",
        "pile.toml:2:12: duration is -1, must be > 0 and <= 1000000 (seconds)",
        "pile.toml:4:1: unknown key \"physics.gravty\", did you mean \"gravity\"?",
        "pile.toml:5:8: drag is nan, must be finite (per second)",
        "pile.toml:6:11: stepper is \"symplectic-eular\", must be \"symplectic-euler\", "
        "\"velocity-verlet\", \"leapfrog\", \"implicit-damping\", \"linearly-implicit\" or \"auto\", "
        "did you mean \"symplectic-euler\"?",
        "pile.toml:7:10: syntax error: floating-point: expected decimal digit or exponent, saw '.'",
        "pile.toml:8:1: key \"step\" is given twice, first in line 7",
        "pile.toml:9:1: radius is missing, a body of shape \"ball\" needs it (meters)",
        "pile.toml:11:12: material \"sand\" is not defined (defined: liquid)",
        "pile.toml:12:1: unknown table \"camra\", did you mean \"camera\"?"};
    CHECK(problemsOf(text) == expected);
}

TEST_CASE("what() has one line for each problem") {
    try {
        scenes::readScene("fps = 0\n", "pile.toml", {});
        FAIL("no error was thrown");
    } catch (const scenes::InputError& error) {
        CHECK(std::string(error.what()) ==
              "pile.toml: title is missing, a scene needs it\n"
              "pile.toml: duration is missing, a scene needs it (seconds)\n"
              "pile.toml: there is nothing to simulate: give a [[body]] or an [[emitter]]\n"
              "pile.toml:1:7: fps is 0, must be 1 to 240 (per second)");
    }
}

TEST_CASE("a file that is not a scene gives a bounded number of problems") {
    std::string text;
    for (int key = 0; key < 1000; ++key) text += "key" + std::to_string(key) + " = 1\n";
    const Lines lines = problemsOf(text);
    CHECK(lines.size() == 201);
    CHECK(lines.back() == "pile.toml: there are more problems than are shown here");
}

TEST_CASE("surface tensions and contact angles that make no sense are refused") {
    const auto material = [](const std::string& lines) { return problemsOf(kBall + "[[material]]\n" + lines); };
    CHECK(material("preset = \"oil\"\ncohesion = -1\n") == Lines{"pile.toml:8:12: cohesion is -1, must be >= 0 (N/m)"});
    CHECK(material("preset = \"solid\"\ncohesion = 1\n") ==
          Lines{"pile.toml:8:12: cohesion needs a cr of at most 1.414, which is 2: particles that attract beyond their "
                "nearest neighbors draw together by themselves"});
    CHECK(material("preset = \"solid\"\ncr = 1.2\ncohesion = 1\n") == Lines{});
    CHECK(problemsOf(kBall + "[[obstacle]]\nshape = \"plane\"\ncontact_angle = 200\n") ==
          Lines{"pile.toml:8:17: contact_angle is 200, must be 0 to 180 (degrees)"});
}

TEST_CASE("random motion needs a surface and damping") {
    const auto material = [](const std::string& lines) { return problemsOf(kBall + "[[material]]\n" + lines); };
    CHECK(
        material("preset = \"oil\"\nagitation = 0.05\n") ==
        Lines{
            "pile.toml:8:13: agitation is a share of the energy of a surface: the material needs a cohesion above 0"});
    CHECK(material("preset = \"oil\"\nbd = 0\ncohesion = 4\nagitation = 0.05\n") ==
          Lines{"pile.toml:10:13: agitation gives back what damping takes: the material needs a bd above 0"});
    CHECK(material("preset = \"oil\"\ncohesion = 4\nagitation = 2\n") ==
          Lines{"pile.toml:9:13: agitation is 2, must be 0 to 1"});
}

TEST_CASE("particles are agitated in equal parts of a frame") {
    const auto intervalWith = [](const std::string& keys) {
        return sceneOf(kBall + "[[material]]\npreset = \"oil\"\ncohesion = 4\n" + keys).setup.agitationInterval;
    };
    CHECK(intervalWith("") == 0.0);
    const double interval = intervalWith("agitation = 0.04\n");
    const double perFrame = 1.0 / (30.0 * interval);
    CHECK(perFrame == Approx(std::round(perFrame)));
    CHECK(intervalWith("agitation = 0.04\nbd = 0.5\n") < interval);  // twice the damping
    CHECK(intervalWith("agitation = 0.08\n") == interval);
}
