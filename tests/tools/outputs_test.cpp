// Tests what the program may write: no output replaces a file that the same command reads or a file of another program,
// names say what is written, and "-" is a standard stream.
#include <cstring>

#include "render/output/png.h"
#include "scenes/text/input_error.h"
#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"

using program::Folder;
using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

constexpr const char* kScene =
    "title = \"points\"\nduration = 0.2\n[[body]]\nshape = \"points\"\npositions = [[0, 1, 0]]\n"
    "[look]\nsize = [64, 36]\n";

/// Runs the program in a folder.
program::Outcome runIn(const Folder& folder, const std::string& arguments) {
    return program::shell("cd '" + (folder / "").string() + "' && " GLOBULAR_PROGRAM " " + arguments);
}

std::string messageOf(const tools::CommandFiles& files) {
    try {
        tools::requireSeparate(files);
    } catch (const scenes::InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("An output is refused if any name of it leads to an input or to another output", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "scene.toml", "scene");
    program::writeText(folder / "other.toml", "scene");
    fs::create_symlink("scene.toml", folder / "link");
    fs::create_hard_link(folder / "scene.toml", folder / "twin");
    fs::create_directory_symlink(folder / "", folder / "here");
    for (const char* name : {"scene.toml", "./scene.toml", "link", "twin", "here/scene.toml"})
        CHECK(messageOf({{folder / "scene.toml"}, {{"-o", folder / name}}, {}}) ==
              "-o " + (folder / name).string() + ": this file is read by the same command and would be lost");
    for (const char* name : {"other.toml", "new", "none/new"})
        CHECK(messageOf({{folder / "scene.toml", folder / "absent"}, {{"-o", folder / name}}, {}}).empty());
    CHECK(messageOf({{}, {{"-a", folder / "new"}, {"-b", folder / "here/new"}}, {}}).find("-b ") == 0);

    const auto isPage = [](const fs::path& file) { return file.extension() == ".html"; };
    const tools::OutputFolder pages{"-o", folder / "pages", isPage};
    program::writeText(folder / "pages/read.html", "read");
    fs::create_symlink("../scene.toml", folder / "pages/linked.html");
    CHECK(messageOf({{folder / "pages/read.html"}, {}, {pages}}).find("read.html in it is read") != std::string::npos);
    CHECK(messageOf({{folder / "scene.toml"}, {}, {pages}}).find("linked.html in it is read") != std::string::npos);
    CHECK(messageOf({{folder / "other.toml"}, {}, {pages}}).empty());
    CHECK(messageOf({{}, {{"-a", folder / "here/pages/new.html"}}, {pages}}).find("writes a file of this name") !=
          std::string::npos);
    CHECK(messageOf({{}, {{"-a", folder / "pages/new.xml"}}, {pages}}).empty());
    const tools::OutputFolder absent{"-o", "no/such/folder/", isPage};
    CHECK(messageOf({{}, {{"-a", folder / "scene.toml"}, {"-b", folder / "twin"}}, {}}).empty());
    CHECK_FALSE(messageOf({{}, {{"-a", "./no/such/folder/a.html"}}, {absent}}).empty());
    CHECK(messageOf({{}, {{"-a", "-"}}, {{"-o", "-", isPage}}}) ==
          "-a -: cannot be standard output; a file of this name is ./-\n"
          "-o -: cannot be standard output; a folder of this name is ./-");
}

TEST_CASE("Commands refuse to write over what they read, before the run", "[outputs]") {
    const Folder folder;
    const std::string scene =
        std::string(kScene) + "[[body]]\nshape = \"file\"\nfile = \"states/particles-00001.ply\"\n";
    program::writeText(folder / "points.toml", kScene);
    REQUIRE(runIn(folder, "simulate points.toml --frames 0-2 -o states --quiet").code == 0);
    REQUIRE(runIn(folder, "render points.toml --frames 0-2 -o frames --quiet").code == 0);
    program::writeText(folder / "mine.toml", scene);
    fs::create_symlink("mine.toml", folder / "link.png");
    fs::create_symlink("frames/frame-00001.png", folder / "link.mp4");
    const std::string states = textOf(folder / "states/particles-00001.ply");
    const std::string frame = textOf(folder / "frames/frame-00001.png");
    for (const char* arguments :
         {"strip mine.toml -o link.png", "render mine.toml --video link.png", "video frames -o link.mp4",
          "video frames -o frames/frame-00001.png", "simulate mine.toml -o states --overwrite",
          "render mine.toml -o mine.toml", "render points.toml -o out --video out/frame-00001.png",
          "compare frames frames --junit frames/frame-00001.png", "compare frames frames --junit link.mp4",
          "compare frames frames --report -", "approve frames -"}) {
        const auto outcome = runIn(folder, arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK_FALSE(fs::exists(folder / "out"));
    }
    CHECK(textOf(folder / "mine.toml") == scene);
    CHECK(textOf(folder / "states/particles-00001.ply") == states);
    CHECK(textOf(folder / "frames/frame-00001.png") == frame);
}

TEST_CASE("A command whose reader goes away ends as if by SIGPIPE, with --json, too", "[outputs]") {
    for (const char* arguments : {"scenes", "scenes --json"}) {
        // The reader is gone before the program starts.
        const program::Outcome outcome =
            program::shell(std::string("( sleep 0.3; " GLOBULAR_PROGRAM " ") + arguments + "; echo $? >&2 ) | true");
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.err == "141\n");
    }
}

TEST_CASE("Particle states among the frames of a run are not removed with them", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "a.toml", kScene);
    REQUIRE(runIn(folder, "render a.toml --frames 0-1 -o frames --quiet").code == 0);
    program::writeText(folder / "frames/particles-00001.ply", "mine");
    CHECK(runIn(folder, "render a.toml --frames 0-1 -o frames --quiet --overwrite").code == 2);
    CHECK(textOf(folder / "frames/particles-00001.ply") == "mine");
}

TEST_CASE("Reports replace pages of globular and no others", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "a.toml", kScene);
    REQUIRE(runIn(folder, "render a.toml --frames 0 -o frames --quiet").code == 0);
    CHECK(runIn(folder, "compare frames frames --report report --quiet").code == 0);
    CHECK(runIn(folder, "compare frames frames --report report --quiet").code == 0);
    program::writeText(folder / "site/index.html", "<!doctype html><title>mine</title>");
    for (const char* arguments :
         {"compare frames frames --report site", "study accuracy --quick -o site", "figures -o site"}) {
        const program::Outcome outcome = runIn(folder, arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("index.html in it was not written by globular") != std::string::npos);
    }
    CHECK(textOf(folder / "site/index.html") == "<!doctype html><title>mine</title>");
}

TEST_CASE("A name that says something else than what is written is refused before the run", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "a.toml", kScene);
    REQUIRE(runIn(folder, "render a.toml --frames 0-1 -o frames --quiet").code == 0);
    for (const char* arguments : {"render a.toml --video film.avi", "render a.toml --video film",
                                  "video frames -o film.mov", "strip a.toml -o strip.jpg", "strip a.toml -o strip"}) {
        const auto outcome = runIn(folder, arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("must end in .") != std::string::npos);
        CHECK_FALSE(fs::exists(folder / "out"));
    }
    CHECK(runIn(folder, "video frames -o film.GIF --quiet").code == 0);
    CHECK(textOf(folder / "film.GIF").starts_with("GIF89a"));
    for (int k = 0; k < 2; ++k) CHECK(runIn(folder, "video frames -o frames/film.webp --quiet").code == 0);
}

TEST_CASE("Names may have 255 bytes, and those that are made of them are shortened", "[outputs]") {
    const Folder folder;
    const std::string longest(250, 'n');
    program::writeText(folder / (longest + ".toml"), kScene);
    CHECK(runIn(folder, "render " + longest + ".toml --frames 0 --quiet").code == 0);
    CHECK(runIn(folder, "simulate " + longest + ".toml --frames 0 --quiet").code == 0);
    CHECK(runIn(folder, "strip " + longest + ".toml --quiet").code == 0);
    CHECK(fs::exists(folder / "out" / longest / "frame-00000.png"));
    CHECK(fs::exists(folder / "out" / (std::string(248, 'n') + "-states") / "run.json"));
    CHECK(fs::exists(folder / "out" / (std::string(245, 'n') + "-strip.png")));
    const std::string picture = std::string(251, 'p') + ".png";
    fs::create_directory(folder / "goldens");
    fs::copy_file(folder / "out" / longest / "frame-00000.png", folder / picture);
    CHECK(runIn(folder, "approve " + picture + " goldens/" + picture).code == 0);
    CHECK(fs::exists(folder / "goldens" / (std::string(250, 'p') + ".json")));
    CHECK(runIn(folder, "compare " + picture + " goldens/" + picture).code == 0);
    CHECK(runIn(folder, "video out/" + longest + " --quiet -o " + std::string(251, 'v') + ".gif").code == 0);
}

TEST_CASE("Names may begin with a dash", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "-a.toml", kScene);
    CHECK(runIn(folder, "render --frames 0-1 --quiet -o -frames --video -film.gif -- -a.toml").code == 0);
    CHECK(fs::exists(folder / "-frames/frame-00001.png"));
    CHECK(textOf(folder / "-film.gif").starts_with("GIF89a"));
    CHECK(runIn(folder, "video -o -again.gif --quiet -- -frames").code == 0);
    CHECK(textOf(folder / "-again.gif") == textOf(folder / "-film.gif"));
}

TEST_CASE("- reads a scene from standard input, and files that it names from the current folder", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "scenes/a.toml", kScene);
    REQUIRE(runIn(folder, "simulate scenes/a.toml --frames 0 -o states --quiet").code == 0);
    program::writeText(folder / "b.toml",
                       std::string(kScene) + "[[body]]\nshape = \"file\"\nfile = \"states/particles-00000.ply\"\n");
    REQUIRE(runIn(folder, "simulate b.toml --frames 1 -o file --quiet").code == 0);
    CHECK(runIn(folder, "simulate - --frames 1 --quiet <b.toml").code == 0);
    CHECK(textOf(folder / "out/stdin-states/particles-00001.ply") == textOf(folder / "file/particles-00001.ply"));
    program::writeText(folder / "wrong.toml", std::string(kScene) + "fps = 0\n");
    const auto wrong = runIn(folder, "check - <wrong.toml");
    CHECK(wrong.code == 2);
    CHECK(wrong.err.find("error: <stdin>:8:1: ") == 0);
    CHECK(runIn(folder, "check - </dev/zero").err == "error: <stdin>: cannot be read: it is larger than 16 MiB\n");
    CHECK(runIn(folder, "check - <&-").code == 2);
    CHECK_FALSE(fs::exists(folder / "-"));
}

TEST_CASE("-o - writes pictures to standard output and everything else to standard error", "[outputs]") {
    const Folder folder;
    program::writeText(folder / "a.toml", kScene);
    REQUIRE(runIn(folder, "render a.toml --frames 0-2 -o frames --quiet").code == 0);
    REQUIRE(runIn(folder, "strip a.toml -o strip.png --quiet").code == 0);
    std::string frames;
    for (const char* name : {"frame-00000.png", "frame-00001.png", "frame-00002.png"})
        frames += textOf(folder / "frames" / name);
    const auto piped = runIn(folder, "render a.toml --frames 0-2 -o - --video film.mp4");
    CHECK(piped.code == 0);
    CHECK(piped.out == frames);
    CHECK(piped.err.find("3 frames to standard output, video film.mp4") != std::string::npos);
    CHECK(fs::exists(folder / "film.mp4"));
    CHECK(runIn(folder, "strip a.toml -o -").out == textOf(folder / "strip.png"));
    CHECK(runIn(folder, "render a.toml -o - | true").code == 0);  // the code of true
    CHECK(runIn(folder, "render a.toml -o - >/dev/full").code == 1);
    for (const char* arguments : {"render a.toml -o - --json", "render a.toml -o - --overwrite",
                                  "strip a.toml -o - --json", "render a.toml --video -", "video frames -o -",
                                  "simulate a.toml -o -", "figures 1 -o -", "study scaling --quick -o -"}) {
        const auto outcome = runIn(folder, arguments);
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.out.empty());
        CHECK(program::lineCount(outcome.err) == 1);
    }
    CHECK_FALSE(fs::exists(folder / "-"));
    CHECK_FALSE(fs::exists(folder / "out"));
}
