// Warnings about particles that start inside obstacles, in gaps without room, or within one another; and none of scenes
// that are as they should be.
#include "scenes/warnings/start_warnings.h"

#include <cstdio>
#include <filesystem>
#include <map>

#include "scenes/build/library.h"
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::sceneOf;

namespace {

/// The warnings of a scene of particles with a radius of 0.1 m. The text stands in line 5 and after.
Lines warningsOf(const std::string& text) {
    return scenes::startWarnings(sceneOf(kTop + "[material]\nradius = 0.1\n" + text));
}

/// Two lines that make a body of one particle.
std::string particleAt(const std::string& position) {
    return "[[body]]\nshape = \"points\"\npositions = [[" + position + "]]\n";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A plane whose normal is flipped has the particles inside") {
    const Lines lines = warningsOf(
        "[[body]]\nshape = \"grid\"\ncounts = [3, 3, 3]\ncenter = [0, 1, 0]\n"
        "[[obstacle]]\nshape = \"plane\"\nnormal = [0, -1, 0]\n");
    // The layers are 0.2 m apart: at 0.8, 1 and 1.2 m.
    CHECK(lines ==
          Lines{"pile.toml:9:1: 27 particles start inside obstacle 1, a plane, up to 1.2 m deep, e.g. at (-0.2, "
                "0.8, -0.2) in body 1 (line 5); is its normal flipped?"});
}

TEST_CASE("Particles inside a box, inside a sphere and outside a container are counted and located") {
    const std::string body = particleAt("0, 0.92, 0], [0, 5, 0");
    const std::string box = "[[obstacle]]\nshape = \"box\"\nminimum = [-1, 0, -1]\nmaximum = [1, 1, 1]\n";
    CHECK(warningsOf(body + box) ==
          Lines{"pile.toml:8:1: 1 particle starts inside obstacle 1, a box, up to 0.08 m deep, "
                "e.g. at (0, 0.92, 0) in body 1 (line 5); move one of the two, or make it smaller"});
    const std::string sphere = "[[obstacle]]\nshape = \"sphere\"\nradius = 0.5\ncenter = [0, 4.7, 0]\n";
    CHECK(warningsOf(body + sphere) ==
          Lines{"pile.toml:8:1: 1 particle starts inside obstacle 1, a sphere, up to 0.2 m "
                "deep, e.g. at (0, 5, 0) in body 1 (line 5); move one of the two, or make it smaller"});
    const std::string container = "[[obstacle]]\nshape = \"container\"\nminimum = [-1, 0, -1]\nmaximum = [1, 4.5, 1]\n";
    CHECK(warningsOf(body + container) ==
          Lines{"pile.toml:8:1: 1 particle starts outside obstacle 1, a container, up to 0.5 m in the solid around it, "
                "e.g. at (0, 5, 0) in body 1 (line 5); make the container larger, or move what is outside it"});
}

TEST_CASE("Containers side by side contradict each other, nested ones do not") {
    const auto container = [](const std::string& low, const std::string& high) {
        return "[[obstacle]]\nshape = \"container\"\nminimum = [" + low + ", 0, -1]\nmaximum = [" + high + ", 2, 1]\n";
    };
    const std::string bodies = particleAt("-2, 1, 0], [2, 1, 0], [2, 1.2, 0");
    // The particle at -2 is outside the second container, the other two are outside the first.
    CHECK(
        warningsOf(bodies + container("-3", "-1") + container("1", "3")) ==
        Lines{"pile.toml:8:1: containers contradict each other: 2 particles are, e.g. at (2, 1, 0) in body 1 (line 5), "
              "outside obstacle 1, but inside obstacle 2 (line 12); a container keeps everything in the scene inside, "
              "so make one container around all, with boxes as walls in it"});
    CHECK(warningsOf(bodies + container("-3", "3") + container("-4", "4")).empty());
    const Lines outer = warningsOf(bodies + container("-4", "4") + container("-3", "1"));
    REQUIRE(outer.size() == 1);
    CHECK(contains(outer[0], "contradict"));
    const std::string emitter = "[[emitter]]\npositions = [[0, 1, 0]]\ninterval = 1\n";
    const Lines emission = warningsOf(emitter + container("-3", "-1") + container("-0.5", "3"));
    REQUIRE(emission.size() == 1);
    CHECK(contains(emission[0], "1 point of emission is, e.g. at (0, 1, 0) in emitter 1 (line 5), outside obstacle 1"));
}

TEST_CASE("A camera that sees nothing of the scene is reported") {
    const std::string ball = "[[body]]\nshape = \"ball\"\nradius = 0.5\njitter = 0\n";
    const auto camera = [](const std::string& keys) { return "[camera]\n" + keys + "\n"; };
    CHECK(warningsOf(ball).empty());
    const Lines away = warningsOf(ball + camera("eye = [0, 0, 9]\ntarget = [0, 0, 18]"));
    CHECK(away ==
          Lines{"pile.toml:9:1: the camera sees nothing of the scene but the ground, at any time; turn its target "
                "to what happens, e.g. at (0, -0.1414, -0.4243)"});
    CHECK(warningsOf(ball + camera("eye = [0, 0, 9]\ntarget = [9, 0, 5]")).size() == 1);
    CHECK(warningsOf(ball + camera("eye = [0, 0, 9]\ntarget = [1, 0, 0]")).empty());
    const std::string flat = "projection = \"orthographic\"\neye = [0, 0, 9]\ntarget = [";
    CHECK(warningsOf(ball + camera(flat + "0, 0, 0]\nhalf_height = 1")).empty());
    // The ball falls 19.6 m in two seconds, past a camera that is 5 m below it.
    CHECK(warningsOf(ball + camera("eye = [0, -5, 9]\ntarget = [0, -5, 0]\nfov = 10")).empty());
    CHECK(warningsOf(ball + camera("eye = [0, 5, 9]\ntarget = [0, 5, 0]\nfov = 10")).size() == 1);
    // What is drawn of an obstacle is seen.
    CHECK(warningsOf(ball + camera("eye = [0, 5, 9]\ntarget = [0, 5, 0]\nfov = 10") +
                     "[[obstacle]]\nshape = \"sphere\"\nradius = 0.5\ncenter = [0, 5, 0]\n")
              .empty());
    // A path of the camera ends at the ball.
    CHECK(warningsOf(ball + "[[camera]]\ntime = 0\neye = [0, 0, 9]\ntarget = [20, 0, 9]\n"
                            "[[camera]]\ntime = 2\neye = [0, 0, 9]\ntarget = [0, 0, 0]\n")
              .empty());
}

TEST_CASE("Edges that are asked for on an invisible box are reported") {
    const std::string box =
        "[[obstacle]]\nshape = \"box\"\nminimum = [5, 0, -1]\nmaximum = [6, 1, 1]\nvisible = false\n";
    const std::string ball = "[[body]]\nshape = \"ball\"\nradius = 0.5\n";
    CHECK(sceneOf(kTop + ball + box).warnings.empty());
    CHECK(sceneOf(kTop + ball + box + "edges = false\n").warnings.empty());
    CHECK(sceneOf(kTop + ball + box + "edges = true\n").warnings ==
          Lines{"pile.toml:11:9: edges = true draws nothing where visible is false; leave visible out, or edges"});
}

TEST_CASE("Transparency of particles that are drawn as spheres is reported") {
    const std::string ball = "[[body]]\nshape = \"ball\"\nradius = 0.5\n[look]\ntransparency = 0.5\n";
    CHECK(sceneOf(kTop + ball + "style = \"metaballs\"\n").warnings.empty());
    CHECK(sceneOf(kTop + ball).warnings ==
          Lines{"pile.toml:7:16: transparency is that of metaballs; look.style = \"spheres\" draws opaque particles"});
}

TEST_CASE("A missed error is reported at its key, or at the table where it was not given") {
    const std::string ball = "[[body]]\nshape = \"ball\"\nradius = 0.5\n";
    const std::string message = scenes::missedErrorWarning(sceneOf(kTop + "[physics]\nerror = 0.05\n" + ball), 4.0);
    CHECK(message.starts_with(
        "pile.toml:4:9: an error of 0.05 radii a second is wanted, but the first frames come to 4; "));
    CHECK(contains(scenes::missedErrorWarning(sceneOf(kTop + ball), 0.14), "ask for physics.error = 0.2 if"));
    CHECK(scenes::missedErrorWarning(sceneOf(kTop + ball), 4.0).starts_with("pile.toml: an error of 0.01 "));
}

TEST_CASE("Particles that rest on an obstacle or lie on its surface are not inside") {
    const std::string plane = "[[obstacle]]\nshape = \"plane\"\n";
    CHECK(warningsOf(particleAt("0, 0.1, 0") + plane).empty());
    CHECK(warningsOf(particleAt("0, 0, 0") + plane).empty());
    CHECK(warningsOf(particleAt("0, -0.04, 0") + plane).empty());
    CHECK(warningsOf(particleAt("0, -0.06, 0") + plane).size() == 1);
}

TEST_CASE("A particle between two obstacles that leave it no room is reported, in a corner it is not") {
    const std::string plane = "[[obstacle]]\nshape = \"plane\"\n";
    const auto lid = [&](const std::string& bottom) {
        return "[[obstacle]]\nshape = \"box\"\nminimum = [-1, " + bottom + ", -1]\nmaximum = [1, 3, 1]\n";
    };
    CHECK(
        warningsOf(particleAt("0, 0.04, 0") + plane + lid("0.08")) ==
        Lines{
            "pile.toml:10:1: 1 particle has no room, the first of them between obstacle 1, a plane, and obstacle 2, a "
            "box, at (0, 0.04, 0) in body 1 (line 5); leave a diameter between the two, or nothing"});
    CHECK(warningsOf(particleAt("0, 0.1, 0") + plane + lid("0.2")).empty());
    CHECK(warningsOf(particleAt("0.05, 0.05, 0.05") + plane +
                     "[[obstacle]]\nshape = \"container\"\nminimum = [0, 0, 0]\nmaximum = [1, 1, 1]\n")
              .empty());
}

TEST_CASE("Points of emission inside an obstacle are reported at the emitter") {
    const std::string plane = "[[obstacle]]\nshape = \"plane\"\n";
    const std::string emitter = "[[emitter]]\npositions = [[0, 1, 0], [0, -1, 0], [0, 0.1, 0]]\ninterval = 1\n";
    CHECK(warningsOf(emitter + plane) ==
          Lines{"pile.toml:5:1: 1 of 3 points of emission are inside obstacle 1, a plane, "
                "up to 1 m deep, e.g. at (0, -1, 0); move them to the side that its normal points to"});
}

TEST_CASE("A rate that does not fit is reported with the rate that does") {
    const std::string disc =
        "[[emitter]]\nshape = \"disc\"\nposition = [0, 9, 0]\nradius = 0.3\nvelocity = [0, -3, 0]\n";
    CHECK(warningsOf(disc).empty());
    CHECK(warningsOf(disc + "rate = 50\n").empty());
    for (const std::string pick : {"staggered", "all", "random"}) {
        const Lines lines = warningsOf(disc + "rate = 500\npick = \"" + pick + "\"\n");
        INFO(pick);
        REQUIRE(lines.size() == 1);
        double fits = 0.0;
        REQUIRE(std::sscanf(lines[0].c_str(), "pile.toml:5:1: emitter 1: asked 500/s, about %lf/s fit", &fits) == 1);
        CHECK(contains(lines[0], "7 points of emission at 3 m/s, and 0."));
        // A particle is out of the way after 0.859 times two radii: 3 t + 4.9 t^2 = 0.172 m, t = 0.053 s. Delays take
        // some of what fits, and random picks more.
        CHECK(fits < 1.02 * 7.0 / 0.053);
        CHECK(fits > (pick == "random" ? 0.6 : 0.9) * 7.0 / 0.053);
    }
    CHECK(warningsOf(disc + "rate = 500\nclearance = 0\n").empty());
}

TEST_CASE("Bodies within each other are reported, bodies side by side are not") {
    const auto ball = [](const std::string& center) {
        return "[[body]]\nshape = \"ball\"\nradius = 0.5\njitter = 0\ncenter = [" + center + "]\n";
    };
    // Lattices that are shifted by a third of a diameter: each particle has its counterpart there.
    const std::size_t count = sceneOf(kTop + "[material]\nradius = 0.1\n" + ball("0, 0, 0")).setup.initial.count();
    CHECK(warningsOf(ball("0, 0, 0") + ball("0, 0.06, 0")) ==
          Lines{"pile.toml:10:1: bodies 1 and 2 overlap: they start with " + std::to_string(count) +
                " pairs of particles closer than 0.6 rest lengths, the closest at 0.3 rest lengths, e.g. at "
                "(0, -0.1414, -0.4243); move them apart, or make one smaller"});
    CHECK(warningsOf(ball("0, 0, 0") + ball("0, 1.1, 0")).empty());
    CHECK(warningsOf(ball("0, 0, 0") + ball("0, 0.9, 0")).size() == 1);
    // The same particles as one body are a matter of its author, unless they are packed too closely.
    CHECK(warningsOf(particleAt("0, 0, 0], [0.1, 0, 0")).empty());
    const Lines coincident = warningsOf(particleAt("0, 0, 0], [0.04, 0, 0], [0, 0, 0"));
    CHECK(coincident ==
          Lines{"pile.toml:5:1: body 1 starts with 3 pairs of particles closer than their core, the "
                "closest at 0 rest lengths, e.g. at (0, 0, 0); give it a larger spacing, or its particles a smaller "
                "radius"});
}

TEST_CASE("Pairs of particles of unequal radii are judged by their own rest length") {
    const std::string large = "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\nparticle_radius = 2\n";
    CHECK(warningsOf(large + particleAt("1.3, 0, 0")).empty());      // 0.62 of 2.1 m
    CHECK(warningsOf(large + particleAt("1.2, 0, 0")).size() == 1);  // 0.57 of 2.1 m
    CHECK(warningsOf(large + particleAt("3, 0, 0], [3.1, 0, 0")).empty());
}

TEST_CASE("Very many close pairs are estimated, and messages of one kind are limited") {
    // 200,000 particles within 0.3 rest lengths: 2e10 pairs.
    const Lines dense = warningsOf("[[body]]\nshape = \"grid\"\ncounts = [200, 100, 10]\nspacing = 0.0002\n");
    REQUIRE(dense.size() == 1);
    CHECK(contains(dense[0], "about "));
    double pairs = 0.0;
    REQUIRE(std::sscanf(dense[0].c_str(), "pile.toml:5:1: body 1 starts with about %lf pairs", &pairs) == 1);
    CHECK(pairs > 0.8 * 2e10);  // of 4000 particles chosen at random, the number of pairs varies by some percent
    CHECK(pairs < 1.2 * 2e10);

    std::string many;
    for (int body = 0; body < 12; ++body)
        many += particleAt(std::to_string(body) + ", 0, 0], [" + std::to_string(body) + ", 0, 0");
    const Lines lines = warningsOf(many);
    REQUIRE(lines.size() == 9);
    CHECK(lines.back() == "pile.toml: and 4 more like the one before");
}

TEST_CASE("Scenes of the repository start with particles where they are meant to be") {
    namespace fs = std::filesystem;
    // On purpose, 64 particles are in one place, and nozzles are in each other's way.
    const std::map<std::string, std::string> warned = {{"hard/coincident", "2016 pairs"},
                                                       {"hard/emission", "emitter 1: asked 1e+03/s, about "}};
    int looked = 0;
    for (const scenes::LibraryEntry& entry : scenes::listScenes(GLOBULAR_SOURCE "/scenes/library")) {
        INFO(entry.name);
        const Lines lines = scenes::startWarnings(scenes::loadScene(entry.path, {}));
        if (warned.contains(entry.name)) {
            REQUIRE(lines.size() == 1);
            CHECK(contains(lines[0], warned.at(entry.name)));
        } else {
            CHECK(lines == Lines{});
        }
        ++looked;
    }
    CHECK(looked > 40);
    for (const char* folder : {GLOBULAR_SOURCE "/docs", GLOBULAR_SOURCE "/examples/scenes"})
        for (const auto& file : fs::directory_iterator(folder))
            if (file.path().extension() == ".toml") {
                INFO(file.path());
                CHECK(scenes::startWarnings(scenes::loadScene(file.path(), {})) == Lines{});
            }
}
