// Tests `render --format`: the files of layers beside or in place of finished pictures, and that each of them keeps
// what holds for a frame: it is resumed, shared out in chunks, and put together byte for byte.
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "render/output/exr.h"
#include "render/picture_formats.h"
#include "tests/catch.h"
#include "tests/tools/early_ends.h"
#include "tests/tools/moving_scene.h"
#include "tests/tools/program.h"

using program::Folder;
using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

/// All formats that this build has.
std::string allFormats() {
    return std::string("rgb,rgba,depth,normal,id") + (render::openExrVersion().empty() ? "" : ",exr");
}

/// The contents of the frames' files in a folder, by name.
std::map<std::string, std::string> framesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("frame-"))
            files[entry.path().filename().string()] = textOf(entry.path());
    return files;
}

std::map<std::string, fs::file_time_type> timesIn(const fs::path& folder) {
    std::map<std::string, fs::file_time_type> times;
    for (const auto& [name, text] : framesIn(folder)) times[name] = fs::last_write_time(folder / name);
    return times;
}

std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& [name, text] : framesIn(folder)) names.push_back(name);
    return names;
}

/// A run of a few small frames.
std::string drawn(const fs::path& folder, const std::string& more) {
    return "render measured/fountain --size 96x54 --quiet --checkpoint 0 -o " + folder.string() + " " + more;
}

void damage(const fs::path& file) {
    std::string bytes = textOf(file);
    bytes.at(60) ^= 1;
    program::writeText(file, bytes);
}

/// The format of this name.
const render::PictureFormat& formatNamed(std::string_view name) {
    for (const render::PictureFormat& format : render::pictureFormats())
        if (format.name == name) return format;
    throw std::logic_error("no such format");
}

/// The 16-bit samples of a PNG file, as FFmpeg reads them.
std::vector<int> samplesOf(const std::vector<std::uint8_t>& png, const std::string& pixelFormat) {
    const Folder folder;
    program::writeText(folder / "a.png", {png.begin(), png.end()});
    const auto outcome = program::shell("ffmpeg -v error -i " + (folder / "a.png").string() + " -f rawvideo -pix_fmt " +
                                        pixelFormat + " -");
    CHECK(outcome.err.empty());
    std::vector<int> samples;
    const auto byte = [&](std::size_t k) { return static_cast<int>(static_cast<std::uint8_t>(outcome.out[k])); };
    for (std::size_t k = 0; k + 1 < outcome.out.size(); k += 2) samples.push_back(256 * byte(k) + byte(k + 1));
    return samples;
}

}  // namespace

TEST_CASE("render writes the formats that are asked for and no others", "[layers]") {
    const Folder folder;
    const auto namesFor = [&](const std::string& flags) {
        const auto outcome = run(drawn(folder / "a", "--frames 1 --overwrite " + flags));
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return namesIn(folder / "a");
    };
    using Names = std::vector<std::string>;
    CHECK(namesFor("") == Names{"frame-00001.png"});
    CHECK(namesFor("--format depth") == Names{"frame-00001.depth.png"});
    CHECK(namesFor("--format id,rgb --format normal --format rgba") ==
          Names{"frame-00001.id.png", "frame-00001.normal.png", "frame-00001.png", "frame-00001.rgba.png"});
    const auto report = nlohmann::json::parse(textOf(folder / "a/run.json"));
    CHECK_FALSE(report.contains("depth"));
}

TEST_CASE("Formats that cannot be had are refused in one line, before anything is drawn", "[layers]") {
    const Folder folder;
    const auto refusal = [&](const std::string& flags) {
        const auto outcome = run(drawn(folder / "a", flags));
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK_FALSE(fs::exists(folder / "a"));
        return outcome.err;
    };
    CHECK(refusal("--format tiff").find("normal") != std::string::npos);
    CHECK(refusal("--format rgb,depth,id --renderer opengl") ==
          "error: --format id: OpenGL draws rgb, depth and normal; the other formats are for --renderer cpu\n");
    CHECK(run("render measured/fountain --frames 0 -o - --format rgb,depth | cat").err ==
          "error: -o -: standard output takes one --format\n");
    const auto piped = run("render measured/fountain --frames 0 --size 96x54 --quiet -o - --format depth | cat");
    REQUIRE(run(drawn(folder / "a", "--frames 0 --format depth")).code == 0);
    CHECK(piped.out == textOf(folder / "a/frame-00000.depth.png"));
}

TEST_CASE("A build without OpenEXR says so before it draws", "[layers]") {
    if (!render::openExrVersion().empty()) {
        SUCCEED("skipped: this build has OpenEXR");
        return;
    }
    const Folder folder;
    const auto outcome = run(drawn(folder / "a", "--format exr"));
    CHECK(outcome.code == 1);
    CHECK(outcome.err ==
          "error: this build has no OpenEXR, which the format exr needs; install libopenexr-dev, then build again\n");
    CHECK(run("--version").out.find("without OpenEXR") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "a"));
}

TEST_CASE("A killed run in several formats is resumed to the same bytes", "[layers]") {
    const Folder folder;
    const std::string flags = "--frames 0-9 --format " + allFormats();
    REQUIRE(run(drawn(folder / "whole", flags)).code == 0);
    const auto whole = framesIn(folder / "whole");
    early_ends::interrupted(drawn(folder / "a", flags), "KILL", early_ends::after(150), folder / "log");
    for (const auto& [name, text] : framesIn(folder / "a")) CHECK(text == whole.at(name));
    REQUIRE(run(drawn(folder / "a", flags + " --resume --threads 1")).code == 0);
    CHECK((framesIn(folder / "a") == whole));
}

TEST_CASE("Exactly the missing and damaged files of layers are made again", "[layers]") {
    const Folder folder;
    const std::string flags = "--frames 0-4 --resume --format rgb,depth,id";
    REQUIRE(run(drawn(folder / "a", flags)).code == 0);
    const auto whole = framesIn(folder / "a");
    const auto before = timesIn(folder / "a");
    const std::set<std::string> made = {"frame-00002.depth.png", "frame-00003.png"};
    fs::remove(folder / "a/frame-00002.depth.png");
    damage(folder / "a/frame-00003.png");
    const auto outcome = run(drawn(folder / "a", flags));
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("frame-00002.depth.png is missing") != std::string::npos);
    CHECK(outcome.err.find("frame-00003.png is damaged") != std::string::npos);
    CHECK((framesIn(folder / "a") == whole));
    for (const auto& [name, time] : timesIn(folder / "a")) {
        INFO(name);
        CHECK((time != before.at(name)) == made.contains(name));
    }
    // A run in another format adds it, and does not touch what is there.
    REQUIRE(run(drawn(folder / "a", "--frames 0-4 --resume --format normal")).code == 0);
    CHECK(framesIn(folder / "a").size() == 20);
    CHECK(textOf(folder / "a/frame-00003.png") == whole.at("frame-00003.png"));
}

TEST_CASE("A file that has the name of a layer and is another's is not touched", "[layers]") {
    const Folder folder;
    program::writeText(folder / "a/frame-00001.depth.png", "mine");
    const auto outcome = run(drawn(folder / "a", "--frames 0-2 --overwrite"));
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("frame-00001.depth.png") != std::string::npos);
    CHECK(textOf(folder / "a/frame-00001.depth.png") == "mine");
}

TEST_CASE("A film is made of finished pictures, whichever layers are written beside them", "[layers]") {
    const Folder folder;
    const auto film = [&](const std::string& name, const std::string& flags) {
        const std::string path = (folder / (name + ".mp4")).string();
        REQUIRE(run(drawn(folder / name, "--frames 0-4 --video " + path + " " + flags)).code == 0);
        return textOf(path);
    };
    const std::string plain = film("plain", "");
    CHECK(film("both", "--format depth,rgb") == plain);
    // Of frames that are there in part, the finished pictures are drawn or read, whichever it takes.
    fs::remove(folder / "both/frame-00001.png");
    fs::remove(folder / "both/frame-00002.depth.png");
    CHECK(film("both", "--format depth,rgb --resume") == plain);
    CHECK(film("plain", "--format rgb,id --resume") == plain);
    CHECK(textOf(folder / "both/frame-00001.png") == textOf(folder / "plain/frame-00001.png"));
    const auto outcome = run(drawn(folder / "a", "--format depth --video " + (folder / "a.mp4").string()));
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "error: --video: a video is made of finished pictures; add rgb to --format\n");
}

TEST_CASE("Chunks of several formats give the files of one run", "[layers]") {
    const program::MovingScene scene;
    const std::string format = " --format " + allFormats();
    REQUIRE(run(scene.draw("direct", format)).code == 0);
    for (const char* chunk : {"1/2", "2/2"})
        REQUIRE(run(scene.fromStates("out", std::string("--chunk ") + chunk + format)).code == 0);
    const fs::path out = scene.folder / "out";
    const auto assemble = [&](const std::string& more) { return run("assemble " + out.string() + " " + more); };
    REQUIRE(assemble("").code == 0);
    CHECK((framesIn(out) == framesIn(scene.folder / "direct")));
    for (const char* key : {"frames", "formats", "asked", "run"})
        CHECK(scene.json("out/manifest.json")[key] == scene.json("direct/manifest.json")[key]);
    for (const char* key : {"depth", "state_hash", "frames"})
        CHECK(scene.json("out/run.json")[key] == scene.json("direct/run.json")[key]);

    // A frame is whole if all of its files are.
    fs::remove(out / "frame-00004.normal.png");
    damage(out / "frame-00007.id.png");
    CHECK(assemble("--print-missing").out == "4,7\n");
    CHECK(assemble("").err.find("are damaged: 7") != std::string::npos);
    const auto before = timesIn(out);
    REQUIRE(run(scene.fromStates("out", "--chunk 1/1 --resume --frames 4,7" + format)).code == 0);
    REQUIRE(assemble("").code == 0);
    for (const auto& [name, time] : timesIn(out)) {
        INFO(name);
        const auto earlier = before.find(name);
        const bool isMade = name == "frame-00004.normal.png" || name == "frame-00007.id.png";
        CHECK((earlier == before.end() || time != earlier->second) == isMade);
    }
    CHECK((framesIn(out) == framesIn(scene.folder / "direct")));
}

TEST_CASE("Chunks without finished pictures have no film", "[layers]") {
    const program::MovingScene scene;
    REQUIRE(run(scene.fromStates("out", "--frames 0-3 --chunk 1/1 --format depth,id")).code == 0);
    const std::string out = (scene.folder / "out").string();
    const auto outcome = run("assemble " + out + " -o " + out + ".mp4");
    CHECK(outcome.code == 2);
    CHECK(outcome.err == "error: -o " + out + ".mp4: " + out +
                             " has no finished pictures, which a video is made of; draw them with --format rgb\n");
    CHECK(run("assemble " + out).out == "4 frames in " + out + " are whole, of 1 chunks\n");
    CHECK(scene.json("out/run.json")["frames"] == 4);
    CHECK(scene.json("out/run.json")["state_hash"] ==
          scene.json("states/manifest.json")["frames"]["00003"]["state_hash"]);
}

TEST_CASE("Ids of more than 16 bits and all depths are in 16-bit pictures", "[layers]") {
    render::Layers layers;
    layers.ids = {0, 1, 65535, 65536, 1'234'567, 4'294'967'295};
    const render::PictureScale scale{{3, 2}, 0.001};
    std::vector<std::uint32_t> ids;
    const auto samples = samplesOf(formatNamed("id").encode(scale, layers), "rgb48be");
    REQUIRE(samples.size() == 18);
    for (std::size_t k = 0; k < 6; ++k) {
        ids.push_back(static_cast<std::uint32_t>(samples[3 * k]) +
                      65536U * static_cast<std::uint32_t>(samples[3 * k + 1]));
        CHECK(samples[3 * k + 2] == 0);
    }
    CHECK(ids == layers.ids);
    for (const float depth : {-1.0F, 0.0F, 0.0004F, 1.2346F, 65.53F, 3e38F}) layers.points.push_back({{}, depth});
    CHECK(samplesOf(formatNamed("depth").encode(scale, layers), "gray16be") ==
          std::vector{65535, 0, 0, 1235, 65530, 65535});
    layers.points = {{{0.0F, 0.0F, 1.0F}, 1.0F}, {{-1.0F, 0.0F, 0.0F}, 1.0F}, {{0.0F, 1.0F, 0.0F}, -1.0F}};
    CHECK(samplesOf(formatNamed("normal").encode({{3, 1}, 0.001}, layers), "rgb48be") ==
          std::vector{32768, 32768, 65535, 0, 32768, 32768, 0, 0, 0});
}
