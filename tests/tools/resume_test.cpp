// Tests runs that end early: the files that are there stay valid, and --resume completes the run to the bytes of one
// that was never disturbed.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "tests/catch.h"
#include "tests/tools/early_ends.h"

using early_ends::after;
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

/// run.json without the fields in which a resumed run may differ.
nlohmann::json resultOf(const fs::path& folder) {
    nlohmann::json json = runOf(folder);
    for (const char* key : {"seconds", "resumed_from"}) json.erase(key);
    return json;
}

void damage(const fs::path& path) {
    std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(static_cast<std::streamoff>(fs::file_size(path) / 2));
    stream.put('!').put('?');
}

}  // namespace

TEST_CASE("A resumed run completes a killed one to the same bytes", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "whole")).code == 0);
    const auto whole = filesOf(folder / "whole");
    REQUIRE(whole.size() == 21);
    for (const int milliseconds : {150, 300, 450, 600}) {
        fs::remove_all(folder / "a");
        fs::remove(folder / "a.mp4");
        interrupted(fountain(folder / "a"), "KILL", after(milliseconds), folder / "log");
        INFO("killed after " << milliseconds << " ms");
        REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
        CHECK(filesOf(folder / "a") == whole);
        CHECK(resultOf(folder / "a") == resultOf(folder / "whole"));
    }
}

TEST_CASE("An animated picture of a resumed run has the bytes of an undisturbed one, and is never half-written",
          "[resume]") {
    const Folder folder;
    for (const std::string extension : {".gif", ".webp"}) {
        INFO(extension);
        const auto film = [&](const std::string& name) { return folder / (name + extension); };
        const auto drawn = [&](const std::string& name, const std::string& more = "") {
            return "render measured/fountain --size 96x54 --frames 0-19 --quiet --checkpoint 0 -o " +
                   (folder / (name + extension + "-frames")).string() + " --video " + film(name).string() + " " + more;
        };
        REQUIRE(run(drawn("whole")).code == 0);
        interrupted(drawn("a"), "KILL",
                    onceThat("test -e " + (folder / ("a" + extension + "-frames")).string() + "/frame-00005.png"),
                    folder / "log");
        CHECK_FALSE(fs::exists(film("a")));
        REQUIRE(run(drawn("a", "--resume")).code == 0);
        CHECK(textOf(film("a")).size() > 1000);
        CHECK(textOf(film("a")) == textOf(film("whole")));
    }
}

TEST_CASE("A run that writes particle states is resumed as well", "[resume]") {
    const Folder folder;
    const auto states = [](const fs::path& to, const std::string& more) {
        return "simulate measured/powder --frames 2-30 --quiet --checkpoint 0 -o " + to.string() + " " + more;
    };
    REQUIRE(run(states(folder / "whole", "")).code == 0);
    interrupted(states(folder / "a", ""), "KILL", after(100), folder / "log");
    REQUIRE(run(states(folder / "a", "--resume")).code == 0);
    CHECK(filesOf(folder / "a") == filesOf(folder / "whole"));
    CHECK(resultOf(folder / "a") == resultOf(folder / "whole"));
}

TEST_CASE("Missing and damaged files are reported and made again", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    const auto whole = filesOf(folder / "a");
    const auto checkpoints = checkpointsIn(folder / "a");
    REQUIRE(checkpoints.size() == 2);  // only the last two are kept

    // If no file is missing, nothing is simulated or drawn.
    REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
    CHECK(runOf(folder / "a")["resumed_from"] == 19);
    CHECK(runOf(folder / "a")["seconds"]["drawing"] == 0.0);

    fs::remove(folder / "a/frame-00019.png");
    auto outcome = run(fountain(folder / "a", "--resume"));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("frame-00019.png is missing") != std::string::npos);
    CHECK(runOf(folder / "a")["resumed_from"] == 18);
    CHECK(filesOf(folder / "a") == whole);

    damage(folder / "a/frame-00007.png");
    outcome = run(fountain(folder / "a", "--resume"));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("frame-00007.png is damaged") != std::string::npos);
    CHECK(runOf(folder / "a")["resumed_from"].is_null());  // both checkpoints are later
    CHECK(filesOf(folder / "a") == whole);

    damage(checkpointsIn(folder / "a").back());
    fs::remove(folder / "a/run.json");
    outcome = run(fountain(folder / "a", "--resume"));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find(checkpointsIn(folder / "a").back().string()) != std::string::npos);
    CHECK(runOf(folder / "a")["resumed_from"] == 18);
    CHECK(filesOf(folder / "a") == whole);

    for (const fs::path& checkpoint : checkpointsIn(folder / "a")) fs::resize_file(checkpoint, 100);
    fs::remove(folder / "a/frame-00019.png");
    outcome = run(fountain(folder / "a", "--resume"));
    CHECK(outcome.code == 0);
    CHECK(runOf(folder / "a")["resumed_from"].is_null());
    CHECK(filesOf(folder / "a") == whole);
}

TEST_CASE("A damaged manifest is an error", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    fs::resize_file(folder / "a/manifest.json", 200);
    const auto outcome = run(fountain(folder / "a", "--resume"));
    CHECK(outcome.code == 1);
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK(outcome.err.find("manifest.json is not a manifest") != std::string::npos);
    REQUIRE(run(fountain(folder / "a", "--overwrite")).code == 0);
}

TEST_CASE("Frames of different runs are never mixed", "[resume]") {
    const Folder folder;
    const std::string base = "render measured/fountain --size 96x54 --frames 0-3 --quiet -o " + (folder / "a").string();
    REQUIRE(run(base).code == 0);
    const auto before = filesOf(folder / "a");
    CHECK(run(base).code == 0);  // the same run may be repeated
    for (const std::string other : {" --set seed=2", " --style spheres", " --quality final", " --set physics.drag=1.5"})
        for (const std::string resume : {"", " --resume"}) {
            const auto outcome = run(base + other + resume);
            INFO(other << resume);
            CHECK(outcome.code == 1);
            CHECK(program::lineCount(outcome.err) == 1);
            CHECK(outcome.err.find("frames of another run") != std::string::npos);
            CHECK(outcome.err.find("--overwrite") != std::string::npos);
            CHECK(filesOf(folder / "a") == before);
        }
    std::string size = base;
    size.replace(size.find("96x54"), 5, "64x36");
    const auto outcome = run(size);
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("size: [96,54] there, [64,36] here") != std::string::npos);
    // --overwrite removes all frames of the old run, including those that the new run does not have.
    REQUIRE(run("render measured/powder --size 64x36 --frames 0-1 --quiet --overwrite -o " + (folder / "a").string()).code == 0);
    CHECK(filesOf(folder / "a").size() == 2);
    CHECK(run(base + " --resume --overwrite").code == 2);
}

TEST_CASE("A short run leaves the newest checkpoint of a longer one", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    fs::remove(folder / "a/frame-00003.png");
    REQUIRE(
        run("render measured/fountain --size 96x54 --frames 0-5 --quiet --checkpoint 0 --resume -o " + (folder / "a").string())
            .code == 0);
    CHECK(runOf(folder / "a")["resumed_from"].is_null());
    CHECK(checkpointsIn(folder / "a").size() == 3);  // 4, 5 and 19
    REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
    CHECK(runOf(folder / "a")["resumed_from"] == 19);
}

TEST_CASE("Without --resume a run starts from the beginning", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    REQUIRE(run(fountain(folder / "a")).code == 0);
    CHECK(runOf(folder / "a")["resumed_from"].is_null());
}

TEST_CASE("Frames are kept without any checkpoint", "[resume]") {
    const Folder folder;
    const std::string arguments =
        "render measured/fountain --size 96x54 --quiet --checkpoint 3600 -o " + (folder / "a").string();
    REQUIRE(interrupted(arguments, "KILL", onceThat("grep -qs 00000 " + (folder / "a/manifest.json").string()),
                        folder / "log") == 137);
    REQUIRE(checkpointsIn(folder / "a").empty());
    const auto manifest = nlohmann::json::parse(textOf(folder / "a/manifest.json"));
    REQUIRE(manifest["frames"].contains("00000"));
    const auto before = fs::last_write_time(folder / "a/frame-00000.png");
    REQUIRE(run(arguments + " --frames 0-3 --resume").code == 0);
    CHECK(fs::last_write_time(folder / "a/frame-00000.png") == before);
}

TEST_CASE("--overwrite removes every file of a run, pictures and states", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    std::ofstream(folder / "a/notes.txt") << "mine";
    const std::string states = "simulate measured/powder --frames 0-2 --quiet -o " + (folder / "a").string();
    CHECK(run(states).code == 1);
    REQUIRE(run(states + " --overwrite").code == 0);
    CHECK(filesOf(folder / "a").size() == 4);  // three states and the video beside the folder
    CHECK(textOf(folder / "a/notes.txt") == "mine");
    fs::remove(folder / "a/manifest.json");
    CHECK(run(fountain(folder / "a")).code == 2);
}

TEST_CASE("Files of another origin are not touched, with --overwrite or without", "[resume]") {
    const Folder folder;
    const std::string name =
        GENERATE("frame-00003.png", "particles-00009.ply", "checkpoint-00002.state", "manifest.json", "run.json");
    INFO(name);
    const std::string content = R"({"format": 1, "name": "a page of mine"})";
    fs::create_directory(folder / "a");
    std::ofstream(folder / "a" / name) << content;
    for (const char* more : {"", "--overwrite", "--resume"}) {
        const auto outcome = run(fountain(folder / "a", more));
        INFO(more << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(outcome.err.find(name + ": this file was not written by a run") != std::string::npos);
        CHECK(textOf(folder / "a" / name) == content);
        CHECK(std::distance(fs::directory_iterator(folder / "a"), fs::directory_iterator()) == 1);
    }
}

TEST_CASE("--overwrite removes the frames that a manifest lists, and no run may have written others", "[resume]") {
    const Folder folder;
    const std::string tiny = "render measured/fountain --size 64x36 --quiet -o " + (folder / "a").string();
    REQUIRE(run(tiny + " --frames 2,4").code == 0);
    // A run that was killed leaves frames that its manifest does not list yet: of those that it was asked for.
    auto manifest = nlohmann::json::parse(textOf(folder / "a/manifest.json"));
    CHECK(manifest["planned"] == nlohmann::json({2, 4}));
    fs::copy_file(folder / "a/frame-00002.png", folder / "a/frame-00003.png");
    CHECK(run(tiny + " --frames 0-1 --overwrite").code == 0);
    CHECK_FALSE(fs::exists(folder / "a/frame-00003.png"));
    fs::copy_file(folder / "a/frame-00001.png", folder / "a/frame-00002.png");
    const std::string other = textOf(folder / "a/frame-00002.png");
    for (const char* more : {" --frames 0-1 --overwrite", " --frames 0-1", " --frames 0-3 --resume"})
        CHECK(run(tiny + more).code == 2);
    CHECK(textOf(folder / "a/frame-00002.png") == other);
    fs::remove(folder / "a/frame-00002.png");
    CHECK(run(tiny + " --frames 0-3 --resume").code == 0);
    CHECK(nlohmann::json::parse(textOf(folder / "a/manifest.json"))["planned"] == nlohmann::json({0, 3}));
}

TEST_CASE("Two runs cannot write into one folder", "[resume]") {
    const Folder folder;
    fs::create_directory(folder / "a");
    const int other = ::open((folder / "a").c_str(), O_RDONLY | O_DIRECTORY);
    REQUIRE(::flock(other, LOCK_EX) == 0);
    const auto outcome = run(fountain(folder / "a"));
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("another run is writing into") != std::string::npos);
    ::close(other);
    CHECK(run(fountain(folder / "a")).code == 0);
}

TEST_CASE("A run leaves alone what another run is writing, and clears away what a killed run has left", "[resume]") {
    const Folder folder;
    const fs::path partial = folder / ".a.mp4.abc123.partial";
    std::ofstream(partial) << "half";
    const int other = ::open(partial.c_str(), O_RDONLY);
    REQUIRE(::flock(other, LOCK_EX) == 0);
    CHECK(run(fountain(folder / "a")).code == 0);
    CHECK(textOf(partial) == "half");
    ::close(other);
    CHECK(run(fountain(folder / "a")).code == 0);
    CHECK_FALSE(fs::exists(partial));
}

TEST_CASE("Frames are not removed for a video that cannot be made", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "a")).code == 0);
    const auto before = filesOf(folder / "a");
    CHECK(run(fountain(folder / "a", "--overwrite --set seed=5"), "PATH=/nonexistent").code == 1);
    CHECK(filesOf(folder / "a") == before);
}

TEST_CASE("Files that a killed run was writing are removed", "[resume]") {
    const Folder folder;
    fs::create_directory(folder / "a");
    std::ofstream(folder / "a/.frame-00003.png.abc123.partial") << "half";
    std::ofstream(folder / "a/.letter.abc123.partial") << "not written by this program";
    REQUIRE(run(fountain(folder / "a")).code == 0);
    CHECK_FALSE(fs::exists(folder / "a/.frame-00003.png.abc123.partial"));
    CHECK(fs::exists(folder / "a/.letter.abc123.partial"));
}

TEST_CASE("An encoder that fails midway costs the video but no frame", "[resume]") {
    const Folder folder;
    REQUIRE(run(fountain(folder / "whole")).code == 0);
    fs::create_directory(folder / "bin");
    // The first call asks which encoders there are; the second takes some frames and fails.
    std::ofstream(folder / "bin/ffmpeg")
        << "#!/bin/sh\n[ \"$5\" = encoder=libx264 ] && { echo Encoder libx264; exit 0; }\n"
           "head -c 100000 >/dev/null\necho 'the encoder fell over' >&2\nexit 7\n";
    fs::permissions(folder / "bin/ffmpeg", fs::perms::owner_all);
    const auto outcome = run(fountain(folder / "a"), "PATH=" + (folder / "bin").string() + ":$PATH");
    CHECK(outcome.code == 1);
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK(outcome.err.find("a.mp4") != std::string::npos);
    CHECK(outcome.err.find("the encoder fell over") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "a.mp4"));
    for (const auto& [name, bytes] : filesOf(folder / "a")) CHECK(bytes == textOf(folder / "whole" / name));
    REQUIRE(run(fountain(folder / "a", "--resume")).code == 0);
    CHECK(filesOf(folder / "a") == filesOf(folder / "whole"));
}
