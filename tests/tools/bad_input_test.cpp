// What goes wrong in the user's hands: one clear line each, and the exit code that says whose fault it was.
#include <fstream>

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
    CHECK(outcome.err.find("wrong.toml:12:10: radius is -0.2, must be > 0 (metres)") != std::string::npos);
}

TEST_CASE("Flags and names that do not exist exit with 2 and say what was meant", "[tools]") {
    for (const char* arguments :
         {"paint", "render", "render liquid --frames 9-3", "render liquid --frames 0-100000", "render liquid --size 12",
          "render liquid --size 8x64", "render liquid --style blobs", "render liquid --set physics.stp=1",
          "render no-such-scene", "check no-such-file.toml", "figures 5", "--nonsense"}) {
        const auto outcome = run(arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(outcome.err.rfind("error: ", 0) == 0);
    }
    CHECK(run("check liqid").err.find("liquid") != std::string::npos);
}

TEST_CASE("The outside world's failures exit with 1 and one line", "[tools]") {
    const program::Folder folder;
    std::ofstream(folder / "file") << "not a folder";
    const std::string output = " -o " + (folder / "frames").string();
    const std::string scene = kTiny;

    const auto backend = run("render " + scene + output + " --gl vulkan");
    CHECK(backend.code == 1);
    CHECK(backend.err == "error: there is no OpenGL backend \"vulkan\"; choose one of: osmesa, egl\n");

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

    const auto noFrames = run("video " + (folder / "frames").string() + " -o " + (folder / "b.mp4").string());
    CHECK(noFrames.code == 1);
    CHECK(program::lineCount(noFrames.err) == 1);
}

TEST_CASE("An unstable run exits with 3 and keeps the frames before", "[tools]") {
    const program::Folder folder;
    const auto outcome =
        run("render powder --size 64x36 --set material[0].b1=1e12 --set physics.stepper=symplectic-euler "
            "--set physics.step=0.01 --frames 0-100 --quiet -o " +
            (folder / "frames").string());
    INFO(outcome.err);
    CHECK(outcome.code == 3);
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK(outcome.err.find("physics.step") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "frames/frame-00000.png"));
    CHECK(program::textOf(folder / "frames/run.json").find("unstable") != std::string::npos);
}
