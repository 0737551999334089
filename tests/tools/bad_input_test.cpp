// Tests what the program reports when something goes wrong: one clear line for each problem, and the exit code that
// tells whose fault it was.
#include <unistd.h>

#include <array>
#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;

namespace {

constexpr const char* kTiny = "figure-2 --set look.size=[64,48] --frames 0-2";

}  // namespace

TEST_CASE("A scene with ten mistakes prints ten messages and exits with 2", "[tools]") {
    const program::Folder folder;
    std::ofstream(folder / "wrong.toml") << "titel = \"misspelt\"\n"
                                            "title = \"ten mistakes\"\n"
                                            "duration = -1\n"
                                            "fps = 30.5\n"
                                            "[physics]\n"
                                            "gravity = [0, -9.8]\n"
                                            "stepper = \"euler\"\n"
                                            "step = 0.01\n"
                                            "step = 0.02\n"
                                            "[material]\n"
                                            "preset = \"jelly\"\n"
                                            "radius = -0.2\n"
                                            "[[body]]\n"
                                            "shape = \"ball\"\n"
                                            "[[obstacle]]\n"
                                            "shape = \"plane\"\n"
                                            "radius = 3\n";
    const auto outcome = run("check " + (folder / "wrong.toml").string());
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out == "");
    CHECK(program::lineCount(outcome.err) == 10);
    CHECK(outcome.err.find("wrong.toml:1:1: ") != std::string::npos);
    CHECK(outcome.err.find("did you mean \"title\"") != std::string::npos);
    CHECK(outcome.err.find("wrong.toml:12:10: radius is -0.2, must be 1e-09 to 10000000 (meters)") !=
          std::string::npos);
}

TEST_CASE("Flags and names that do not exist exit with 2 and say what was meant", "[tools]") {
    for (const char* arguments :
         {"paint", "render", "render measured/liquid --frames 9-3", "render measured/liquid --frames 0-100000", "render measured/liquid --size 12",
          "render measured/liquid --size 8x64", "render measured/liquid --style blobs", "render measured/liquid --set physics.stp=1",
          "render no-such-scene", "render measured/liquid --gl vulkan", "check no-such-file.toml", "figures 5", "--nonsense"}) {
        const auto outcome = run(arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(outcome.err.rfind("error: ", 0) == 0);
    }
    for (const char* number : {"1e400", "inf", "nan", "-1", "5s"})
        CHECK(run("render measured/liquid --frames 0 --checkpoint " + std::string(number)).err ==
              "error: --checkpoint: " + std::string(number) + " must be a number >= 0\n");
    CHECK(run("check liqid").err.find("liquid") != std::string::npos);
    CHECK(run("render measured/liquid --gl vulkan").err.find("choose one of: osmesa, egl") != std::string::npos);
}

TEST_CASE("A label that cannot be drawn as it is written is warned of, on one line", "[tools]") {
    const auto warningOf = [](const std::string& label) {
        return run("check paper/attraction-1 --set look.color_by=speed --set overlay.color_bar=true "
                   "--set 'overlay.color_label=\"" +
                   label + "\"'")
            .err;
    };
    CHECK(warningOf("Geschwindigkeit, v\u0304").empty());
    CHECK(warningOf("速度 of 速") == "warning: the font has no \"速度\", which overlay.color_label asks for\n");
    CHECK(warningOf("a\\nb") == "warning: the font has no \"\\n\", which overlay.color_label asks for\n");
    CHECK(warningOf("سرعة").find("written from right to left") != std::string::npos);
}

TEST_CASE("A wrong word of the command line is named, with the nearest one that exists", "[tools]") {
    CHECK(run("").err == "error: missing command; see globular --help\n");
    CHECK(run("rendr liquid").err == "error: unknown command \"rendr\", did you mean \"render\"?\n");
    CHECK(run("paint").err == "error: unknown command \"paint\"; see globular --help\n");
    CHECK(run("study").err == "error: missing command; see globular study --help\n");
    CHECK(run("study acuracy").err == "error: unknown command \"acuracy\", did you mean \"accuracy\"?\n");
    CHECK(run("render measured/liquid --sice 64x36").err == "error: unknown flag \"--sice\", did you mean \"--size\"?\n");
    CHECK(run("check measured/liquid solid").err == "error: unknown argument \"solid\"; see globular check --help\n");
    CHECK(run("render").err == "error: SCENE is required\n");
    for (const char* arguments : {"", "rendr liquid", "study", "render measured/liquid --sice 64x36", "check measured/liquid solid"})
        CHECK(run(arguments).code == 2);
}

TEST_CASE("Failures of files and other programs exit with 1 and one line", "[tools]") {
    const program::Folder folder;
    std::ofstream(folder / "file") << "not a folder";
    const std::string output = " -o " + (folder / "frames").string();
    const std::string scene = kTiny;

    const auto unwritable = run("render " + scene + " -o " + (folder / "file").string() + "/frames");
    INFO(unwritable.err);
    CHECK(unwritable.code == 1);
    CHECK(program::lineCount(unwritable.err) == 1);
    CHECK(unwritable.err.find("Not a directory") != std::string::npos);

    const auto noFfmpeg =
        run("render " + scene + output + " --video " + (folder / "a.mp4").string(), "PATH=/nonexistent");
    INFO(noFfmpeg.err);
    CHECK(noFfmpeg.code == 1);
    CHECK(program::lineCount(noFfmpeg.err) == 1);
    CHECK(noFfmpeg.err.find("ffmpeg") != std::string::npos);

    // This is noticed before anything is drawn and before old frames are removed.
    std::filesystem::create_directory(folder / "film.mp4");
    const auto isFolder = run("render " + scene + output + " --video " + (folder / "film.mp4").string());
    INFO(isFolder.err);
    CHECK(isFolder.code == 1);
    CHECK(isFolder.err.find("it is a folder") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "frames/frame-00000.png"));
    REQUIRE(run("render " + scene + output).code == 0);
    CHECK(run("render " + scene + output + " --overwrite --video " + (folder / "film.mp4").string()).code == 1);
    CHECK(std::filesystem::exists(folder / "frames/frame-00000.png"));

    const auto noFrames = run("video " + (folder / "none").string() + " -o " + (folder / "b.mp4").string());
    CHECK(noFrames.code == 1);
    CHECK(program::lineCount(noFrames.err) == 1);
}

TEST_CASE("An unstable run exits with 3 and keeps the frames before", "[tools]") {
    const program::Folder folder;
    const auto outcome =
        run("render measured/powder --size 64x36 --set material[0].b1=1e12 --set physics.stepper=symplectic-euler "
            "--set physics.step=0.01 --set physics.wall=paper --frames 0-100 --quiet -o " +
            (folder / "frames").string());
    INFO(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK(outcome.err.find("physics.step") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "frames/frame-00000.png"));
    CHECK(program::textOf(folder / "frames/run.json").find("unstable") != std::string::npos);
    // The hash is that of the last frame, so the manifest has it as well.
    const auto json = nlohmann::json::parse(program::textOf(folder / "frames/run.json"));
    const std::string hash = json["state_hash"];
    CHECK(program::textOf(folder / "frames/manifest.json").find(hash) != std::string::npos);
}

TEST_CASE("check describes a scene that becomes unstable at once", "[tools]") {
    const auto outcome =
        run("check measured/liquid --set material.b1=1e12 --set physics.stepper=symplectic-euler --set physics.step=0.01 "
            "--set physics.wall=paper");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 3);
    CHECK(outcome.out.find("cutoff 0.6 m") != std::string::npos);
    CHECK(outcome.out.find("b1 1e+12, bd 0.15, cr 1, cd 2, radius 0.15 m, mass 0.1 kg") != std::string::npos);
    CHECK(outcome.out.find("unstable after 0 frames") != std::string::npos);
    CHECK(program::lineCount(outcome.err) == 1);
}

TEST_CASE("check says what follows from the size of particles, and how far bodies sink", "[tools]") {
    const auto outcome = run("check measured/liquid --set resolution=0.5 --set material.b1=0.04");
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("b1 2.56, bd 0.3, cr 1, cd 2, radius 0.3 m, mass 0.8 kg") != std::string::npos);
    CHECK(
        outcome.out.find("\n           radius 0.3 at resolution 0.5 is 2 times that of the preset liquid: mass 0.8, b1 "
                         "2.56, bd 0.3 follow\n") != std::string::npos);
    CHECK(outcome.out.find("\nbody       1: a column as tall as it, ") != std::string::npos);
    CHECK(outcome.out.find(" of its height by its own weight\n") != std::string::npos);
}

TEST_CASE("bench refuses a filter that no row contains, and names the rows", "[tools]") {
    for (const char* format : {"", " --json"}) {
        const auto outcome = run(std::string("bench --filter zzz") + format);
        INFO(outcome.out << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(outcome.err.find("no row contains \"zzz\"") != std::string::npos);
        for (const char* row : {"copy", "forces", "settled solid", "step velocity-verlet", "draw frame", "honey"})
            CHECK(outcome.err.find(row) != std::string::npos);
    }
    // Steps are measured up to 100,000 particles only.
    CHECK(run("bench --filter \"step symplectic\" --particles 1000000 --rounds 1").code == 2);
}

TEST_CASE("The message of an unstable run names the keys that have an effect", "[tools]") {
    // Nozzles whose particles overlap from the start.
    const std::string stiff =
        "check measured/powder --quiet --set material[0].b1=1e22 --set emitter[0].pick=all --set emitter[0].jitter=0.25 "
        "--set emitter[0].clearance=0.9 --set physics.stepper=";
    const auto automatic = run(stiff + "auto");
    INFO(automatic.err);
    CHECK(automatic.code == 3);
    CHECK(automatic.err.find("after 0 steps, in a step of ") != std::string::npos);
    CHECK(automatic.err.find("lower physics.error, or raise material.mass") != std::string::npos);
    CHECK(run(stiff + "symplectic-euler --set physics.step=0.01 --set physics.wall=paper")
              .err.find("lower physics.step, or raise material.mass") != std::string::npos);

    const program::Folder folder;
    std::ofstream(folder / "far.toml") << "title = \"far\"\nduration = 1\n[material]\nradius = 1\n[[emitter]]\n"
                                          "position = [99999999.9, 0, 0]\nvelocity = [0, 9, 0]\ninterval = 0.02\n"
                                          "jitter = 0.9\nclearance = 0\n";
    const auto outside = run("check --quiet " + (folder / "far.toml").string());
    INFO(outside.err);
    CHECK(outside.code == 3);
    CHECK(outside.err.find("change the body or the emitter that it comes from") != std::string::npos);
    CHECK(outside.err.find("physics.") == std::string::npos);
}

TEST_CASE("Exit codes do not depend on whether the output can be written", "[tools]") {
    const auto codeOf = [](const std::string& line) { return program::shell(line).code; };
    const std::string program = GLOBULAR_PROGRAM;
    for (const char* deaf : {" 2>/dev/full", " 2>&-", " >&- 2>&-"}) {
        INFO(deaf);
        CHECK(codeOf(program + " check no-such-file.toml" + deaf) == 2);
    }
    CHECK(codeOf(program + " scenes >/dev/full 2>/dev/null") == 1);
    CHECK(codeOf(program + " scenes >&- 2>/dev/null") == 1);
    // A reader of the output that goes away does not end a run.
    const program::Folder folder;
    const std::string frames = " --size 64x36 --frames 0-2 -o " + (folder / "frames").string();
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    ::close(ends[0]);
    REQUIRE(::dup2(ends[1], 9) == 9);  // the shell accepts only one digit
    // The program replaces the shell by exec, because a shell would report the same code for a child that a signal
    // killed.
    CHECK(codeOf("exec " + program + " render measured/powder" + frames + " >&9 2>&9") == 141);
    CHECK(std::filesystem::exists(folder / "frames/run.json"));
    const auto unread = program::shell("exec " + program + " schema >&9");
    CHECK(unread.code == 141);
    CHECK(unread.err.empty());
    ::close(9);
    ::close(ends[1]);
    CHECK(codeOf(program + " --version >/dev/full 2>/dev/null") == 1);
    CHECK(codeOf(program + " bench --filter copy --rounds 1 >/dev/full 2>/dev/null") == 1);
}

TEST_CASE("Scenes that would never end or overload the reader are refused", "[tools]") {
    const program::Folder folder;
    const std::string scene = "title = \"t\"\nduration = 1\n[[body]]\nshape = \"ball\"\nradius = 0.3\n";
    std::string deep;
    for (int part = 0; part < 20000; ++part) deep += "a.";
    const auto problem = [&](const std::string& text, const std::string& more = "") {
        std::ofstream(folder / "a.toml") << text;
        const auto outcome = run("check " + (folder / "a.toml").string() + more);
        CHECK(outcome.code == 2);
        return outcome.err;
    };
    CHECK(problem(scene + "[physics]\nstep = 1e-300\n").find("a.toml:7:8: step is 1e-300") != std::string::npos);
    CHECK(problem(scene + "[[emitter]]\nposition = [0, 0, 0]\ninterval = 1e-17\n").find(":8:12: interval is 1e-17") !=
          std::string::npos);
    CHECK(problem(deep + "a = 1\n" + scene).find("a.toml:1:1: the key has more than 256 parts") != std::string::npos);
    CHECK(problem("\"\" = 3\n" + scene).find("a.toml:1:1: unknown key") != std::string::npos);
    CHECK(problem(scene + "[\"\"]\n").find("unknown table") != std::string::npos);
    CHECK(problem(scene, " --set duration.value=9").find("duration is not a table") != std::string::npos);
    CHECK(problem(scene + "[[body]]\nshape = \"points\"\npositions = [[1e300, 0, 0]]\n").find("positions[0][0] is") !=
          std::string::npos);
    CHECK(problem("title = \"t\"\nduration = 1\n[[body]]\nshape = \"points\"\npositions = [[0, 0, 0], [1, 0, 0]]\n",
                  " --limit particles=1")
              .find("2 particles, at most 1 are allowed") != std::string::npos);
}

TEST_CASE("A particle file beyond the bounds of the world is wrong input, whether the scene is run or not", "[tools]") {
    const program::Folder folder;
    const double position[] = {0.0, 3e8, 0.0};
    std::ofstream(folder / "far.ply", std::ios::binary)
        << "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
           "property double x\nproperty double y\nproperty double z\nend_header\n"
        << std::string(reinterpret_cast<const char*>(position), sizeof position);
    std::ofstream(folder / "far.toml")
        << "title = \"far\"\nduration = 1\n[[body]]\nshape = \"file\"\nfile = \"far.ply\"\n";
    const std::string scene = (folder / "far.toml").string();
    const std::string message = "far.ply: particle 0: y is 300000000, must be -100000000 to 100000000\n";
    for (const std::string& command :
         {"check " + scene, "render --frames 0 " + scene + " -o " + (folder / "out").string()}) {
        INFO(command);
        const auto outcome = run(command);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find(message) != std::string::npos);
    }
}
