// Tests that signals end a run soon, wherever it is, and that what was finished is kept.
#include <cstdlib>
#include <fstream>
#include <utility>

#include "tests/catch.h"
#include "tests/tools/early_ends.h"

using early_ends::checkpointsIn;
using early_ends::filesOf;
using early_ends::fountain;
using early_ends::interrupted;
using early_ends::onceThat;
using early_ends::runOf;
using program::Folder;
using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

/// Time that the last run took to end after its last signal, s.
double secondsToEnd(const fs::path& log) {
    return 1e-9 * (std::stod(textOf(log.string() + ".ended")) - std::stod(textOf(log.string() + ".sent")));
}

/// Times within which a run has to end after the first and after the second signal, s: two seconds and a tenth, and
/// some for a machine with other work.
constexpr double kSoon = 2.5;
constexpr double kAtOnce = 0.35;

}  // namespace

TEST_CASE("A signal ends a run after the current frame, with a video that plays and a way to resume", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "whole")).code == 0);
    const std::string arguments = "render measured/fountain --size 96x54 --quiet --checkpoint 100 -o " +
                                  (folder / "a").string() + " --video " + (folder / "a.mp4").string();
    const auto [signal, code] = GENERATE(std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129});
    CHECK(interrupted(arguments, signal, onceThat("test -e " + (folder / "a/frame-00030.png").string()),
                      folder / "log") == code);
    CHECK(textOf(folder / "log").find("--resume") != std::string::npos);
    CHECK(program::lineCount(textOf(folder / "log")) == 1);
    const auto json = runOf(folder / "a");
    CHECK(json["interrupted"] == true);
    const int frames = json["frames"];
    INFO("after " << frames << " frames");
    REQUIRE(frames < 240);
    REQUIRE(checkpointsIn(folder / "a").size() == 1);
    // The video has the frames that are there.
    REQUIRE(run("video " + (folder / "a").string() + " --quiet --fps 30 -o " + (folder / "again.mp4").string()).code ==
            0);
    CHECK(textOf(folder / "again.mp4") == textOf(folder / "a.mp4"));
    REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
    CHECK(runOf(folder / "a")["resumed_from"] == (frames > 20 ? nlohmann::json() : nlohmann::json(frames - 1)));
    CHECK(textOf(folder / "a.mp4") == textOf(folder / "whole.mp4"));
    CHECK(textOf(folder / "a/frame-00019.png") == textOf(folder / "whole/frame-00019.png"));
}

TEST_CASE("A signal ends a run inside a frame that takes long, and a second one at once", "[resume]") {
    const Folder folder;
    // A frame of more than a million steps.
    const std::string arguments =
        "simulate measured/liquid --set physics.stepper=\\\"velocity-verlet\\\" --set physics.step=2e-8 -o " +
        (folder / "a").string();
    const std::string log = (folder / "log").string();
    const auto [signal, code] = GENERATE(std::pair{"INT", 130}, std::pair{"TERM", 143});
    const bool isTwice = GENERATE(false, true);
    INFO(signal << (isTwice ? " twice" : ""));
    std::string when = onceThat("grep -q \"% of its time, steps of 2e-08 s\" " + log);
    if (isTwice) when += std::string("; kill -") + signal + " $child; sleep 0.1";
    CHECK(interrupted(arguments, signal, when, log) == code);
    CHECK(secondsToEnd(log) < (isTwice ? kAtOnce : kSoon));
    const std::string text = textOf(log);
    INFO(text);
    CHECK(text.find("interrupted after ") != std::string::npos);
    CHECK((text.find("ending within two seconds; press again to stop now") != std::string::npos) == (code == 130));
    const auto json = runOf(folder / "a");
    CHECK(json["interrupted"] == true);
    CHECK_FALSE(json.contains("energy"));  // the state inside the frame is none of the run's
    for (const auto& entry : fs::directory_iterator(folder / "a")) CHECK(entry.path().extension() != ".partial");
}

TEST_CASE("A run ends in time while it draws a picture that takes long, and its folder is of use", "[resume]") {
    const Folder folder;
    const std::string log = (folder / "log").string();
    const std::string drawing =
        "render measured/liquid --size 3840x2160 --quality final --frames 0-19 --threads 1 -o " + (folder / "a").string();
    const bool isTwice = GENERATE(false, true);
    std::string when = onceThat("test -e " + (folder / "a").string()) + "; sleep 1";
    if (isTwice) when += "; kill -TERM $child; sleep 0.1";
    CHECK(interrupted(drawing, "TERM", when, log) == 143);
    CHECK(secondsToEnd(log) < (isTwice ? kAtOnce : kSoon));
    CHECK(textOf(log).find("to go on, give the same command with --resume") != std::string::npos);
    const std::string small =
        "render measured/fountain --size 96x54 --frames 0-3 --quiet --overwrite -o " + (folder / "a").string();
    CHECK(run(small).code == 0);
}

TEST_CASE("A run ends in time while ffmpeg makes its last pass, and a resumed one makes the video", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "whole")).code == 0);
    fs::create_directory(folder / "bin");
    // The first call asks which encoders there are; the second takes all frames and does not end.
    std::ofstream(folder / "bin/ffmpeg")
        << "#!/bin/sh\n[ \"$5\" = encoder=libx264 ] && { echo Encoder libx264; exit 0; }\n"
           "cat >/dev/null\ntouch " +
               (folder / "last").string() + "\nsleep 60\n";
    fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
    const bool isTwice = GENERATE(false, true);
    std::string when = onceThat("test -e " + (folder / "last").string());
    if (isTwice) when += "; kill -TERM $child; sleep 0.1";
    const std::string log = (folder / "log").string();
    const std::string path = ::getenv("PATH");
    ::setenv("PATH", ((folder / "bin").string() + ":" + path).c_str(), 1);
    CHECK(interrupted(fountain(folder / "a"), "TERM", when, log) == 143);
    ::setenv("PATH", path.c_str(), 1);
    CHECK(secondsToEnd(log) < (isTwice ? kAtOnce : kSoon));
    CHECK(runOf(folder / "a")["frames"] == 20);
    CHECK(runOf(folder / "a")["interrupted"] == true);
    CHECK_FALSE(fs::exists(folder / "a.mp4"));
    for (const auto& entry : fs::directory_iterator(folder / "")) CHECK(entry.path().extension() != ".partial");
    REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
    CHECK(filesOf(folder / "a") == filesOf(folder / "whole"));
}

TEST_CASE("A signal that a run was started to ignore stays ignored", "[resume]") {
    const Folder folder;
    const std::string arguments = "render measured/fountain --size 96x54 --quiet --frames 0-30 -o " + (folder / "a").string();
    const std::string signal = GENERATE("INT", "HUP");
    CHECK(interrupted(arguments, signal, onceThat("test -e " + (folder / "a/frame-00005.png").string()), folder / "log",
                      "--ignore-signal") == 0);
    CHECK(runOf(folder / "a")["frames"] == 31);
}
