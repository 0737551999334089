// Tests whole runs of the program: they write the promised files, repeat them byte for byte, and video and frames
// agree.
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "render/output/png.h"
#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/system/output_file.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

/// A short, small run of a scene of metaballs with shadows, births and obstacles.
std::string fountainRun(const fs::path& folder, const std::string& more) {
    return "render measured/fountain --size 160x90 --frames 0-9 --quiet -o " + folder.string() + " --video " +
           folder.string() + ".mp4 " + more;
}

std::vector<std::string> frameBytes(const fs::path& folder) {
    std::vector<std::string> frames;
    for (int k = 0; k < 10; ++k) frames.push_back(textOf(folder / ("frame-0000" + std::to_string(k) + ".png")));
    return frames;
}

}  // namespace

TEST_CASE("A run leaves every frame, a video and a complete run.json, and repeats itself byte for byte", "[tools]") {
    const program::Folder folder;
    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    REQUIRE(run(fountainRun(folder / "b", "")).code == 0);
    REQUIRE(run(fountainRun(folder / "c", "--threads 1")).code == 0);
    const auto frames = frameBytes(folder / "a");
    for (const std::string& frame : frames) CHECK(frame.size() > 500);
    CHECK(frames[9] != frames[1]);
    CHECK(frameBytes(folder / "b") == frames);
    CHECK(frameBytes(folder / "c") == frames);
    CHECK(textOf(folder / "a.mp4").size() > 1000);
    CHECK(textOf(folder / "b.mp4") == textOf(folder / "a.mp4"));
    CHECK(textOf(folder / "c.mp4") == textOf(folder / "a.mp4"));

    const auto json = nlohmann::json::parse(textOf(folder / "a/run.json"));
    for (const char* key :
         {"scene",          "scene_hash", "version",         "threads",          "instruction_set", "renderer",
          "gl_renderer",    "gl_version", "particles",       "births",           "refused_births",  "deaths",
          "strays",         "emitters",   "frames",          "stepper",          "steps",           "seconds",
          "error_estimate", "energy",     "linear_momentum", "angular_momentum", "state_hash"})
        CHECK(json.contains(key));
    CHECK(json["frames"] == 10);
    CHECK(json["steps"]["count"] >= 9);  // at least one between two frames
    CHECK(json["particles"] > 100);
    CHECK(json["walls"] ==
          nlohmann::json({{"held", 0}, {"deepest", 0.0}, {"centers_outside", 0}}));  // still in the air
    const auto single = nlohmann::json::parse(textOf(folder / "c/run.json"));
    CHECK(single["threads"] == 1);
    CHECK(single["state_hash"] == json["state_hash"]);
    CHECK(single["scene_hash"] == json["scene_hash"]);
}

TEST_CASE("run.json of a run with heat says where the heat is from, and others have no word of it", "[tools]") {
    const program::Folder folder;
    const std::string scene = (folder / "wax.toml").string();
    const auto write = [&](const std::string& heat, const std::string& plate) {
        std::ofstream(scene) << "title = \"wax\"\nduration = 1\nfps = 20\n[physics]\nstepper = \"velocity-verlet\"\n"
                                "[[material]]\nname = \"wax\"\npreset = \"solid\"\nradius = 0.05\n"
                             << heat << "[[body]]\nshape = \"box\"\nminimum = [-0.2, 0, -0.2]\n"
                             << "maximum = [0.2, 0.3, 0.2]\n[[obstacle]]\nshape = \"plane\"\n"
                             << plate;
    };
    const auto simulated = [&](const std::string& name) {
        REQUIRE(run("simulate " + scene + " --quiet -o " + (folder / name).string()).code == 0);
        return nlohmann::json::parse(textOf(folder / name / "run.json"));
    };
    write("", "");
    CHECK_FALSE(simulated("cold").contains("heat"));
    const std::string heat = "capacity = 1000\nconductivity = 200\nmelting = 302\nlatent = 100\ntemperature = 301\n";
    const std::string melts =
        "melts_to = \"melt\"\n[[material]]\nname = \"melt\"\npreset = \"mud\"\nradius = 0.05\n"
        "capacity = 1000\n";
    write(heat + melts, "temperature = 400\n");
    const auto hot = simulated("hot")["heat"];
    CHECK(hot["exchanges"] == 38);  // two in each of 19 frames
    CHECK(hot["received"] > 0.0);
    CHECK(hot["from_motion"] > 0.0);
    CHECK(hot["paid_for_melting"] != 0.0);
    write(heat, "temperature = 200\n");
    const auto chilled = simulated("chilled")["heat"];
    CHECK(chilled["received"] < 0.0);
    CHECK(chilled["paid_for_melting"] == 0.0);
}

TEST_CASE("A run and check say what random motion takes", "[tools]") {
    const program::Folder folder;
    const std::string scene = (folder / "drop.toml").string();
    std::ofstream(scene) << "title = \"drop\"\nduration = 0.2\nfps = 10\n[material]\npreset = \"oil\"\ncohesion = 10\n"
                            "agitation = 0.05\n[[body]]\nshape = \"ball\"\nradius = 0.4\n";
    const auto check = nlohmann::json::parse(run("check " + scene + " --json").out);
    const double interval = check["agitation_interval"];
    CHECK(check["materials"][0]["agitation"] == 0.05);
    CHECK(run("check " + scene).out.find("random impulses every") != std::string::npos);
    REQUIRE(run("simulate " + scene + " --quiet -o " + (folder / "drop").string()).code == 0);
    const auto agitation = nlohmann::json::parse(textOf(folder / "drop" / "run.json"))["agitation"];
    CHECK(agitation["count"] == std::lround(0.1 / interval));  // one of two frames is simulated
    CHECK(agitation["work"] > 0.0);
}

TEST_CASE("A run and check say that particles have left the scene", "[tools]") {
    const program::Folder folder;
    const std::string scene = (folder / "table.toml").string();
    std::ofstream(scene) << "title = \"table\"\nduration = 3\nfps = 10\n[material]\npreset = \"solid\"\n"
                            "[[body]]\nshape = \"points\"\npositions = [[0, 1, 0], [2, 1, 0], [2.3, 1, 0]]\n"
                            "[[obstacle]]\nshape = \"box\"\ncenter = [0, 0, 0]\nsize = [1, 1, 1]\n";
    const auto strays = [&](const std::string& name) {
        return nlohmann::json::parse(textOf(folder / name / "run.json"))["strays"];
    };
    const std::string to = "simulate " + scene + " --quiet -o ";
    const auto whole = run(to + (folder / "whole").string());
    CHECK(whole.code == 0);
    CHECK(whole.err ==
          "warning: 2 particles have left the scene and will be computed until the run ends; a [world] with bounds "
          "removes them\n");
    CHECK(strays("whole") == 2);
    const auto check = run("check " + scene);
    CHECK(check.code == 0);
    CHECK(check.out.find("\nwarning    2 particles have left the scene") != std::string::npos);
    const auto bounded = run(to + (folder / "bounded").string() + " --set 'world.minimum=[-9, -9, -9]'");
    CHECK(bounded.code == 0);
    CHECK(bounded.err.empty());
    CHECK(strays("bounded") == 0);
}

TEST_CASE("A list of frames gives just these frames, and is resumed", "[tools]") {
    const program::Folder folder;
    const std::string states = "simulate measured/powder --quiet --checkpoint 0 -o ";
    REQUIRE(run(states + (folder / "all").string() + " --frames 0-9").code == 0);
    const std::string list = states + (folder / "list").string() + " --frames 1,3-9:3";
    REQUIRE(run(list).code == 0);
    std::set<std::string> names;
    for (const auto& file : fs::directory_iterator(folder / "list"))
        if (file.path().extension() == ".ply") names.insert(file.path().filename().string());
    const std::set<std::string> wanted = {"particles-00001.ply", "particles-00003.ply", "particles-00006.ply",
                                          "particles-00009.ply"};
    CHECK(names == wanted);
    for (const std::string& name : names) CHECK(textOf(folder / "list" / name) == textOf(folder / "all" / name));
    CHECK(nlohmann::json::parse(textOf(folder / "list/run.json"))["frames"] == 4);

    fs::remove(folder / "list/particles-00009.ply");
    REQUIRE(run(list + " --resume").code == 0);
    const auto resumed = nlohmann::json::parse(textOf(folder / "list/run.json"));
    CHECK(resumed["frames"] == 4);
    CHECK(resumed["resumed_from"] == 8);  // a frame that is not in the list, but has a checkpoint
    CHECK(textOf(folder / "list/particles-00009.ply") == textOf(folder / "all/particles-00009.ply"));
}

TEST_CASE("Leaving frames out changes none of those that are drawn", "[tools]") {
    const program::Folder folder;
    const std::string small = "render measured/fountain --size 160x90 --quiet -o ";
    REQUIRE(run(small + (folder / "all").string() + " --frames 0-9").code == 0);
    REQUIRE(run(small + (folder / "last").string() + " --frames 9").code == 0);
    CHECK(textOf(folder / "last/frame-00009.png") == textOf(folder / "all/frame-00009.png"));
    CHECK(nlohmann::json::parse(textOf(folder / "last/run.json"))["state_hash"] ==
          nlohmann::json::parse(textOf(folder / "all/run.json"))["state_hash"]);
    REQUIRE(run("simulate measured/fountain --frames 9 --quiet -o " + (folder / "states").string()).code == 0);
    CHECK(nlohmann::json::parse(textOf(folder / "states/run.json"))["state_hash"] ==
          nlohmann::json::parse(textOf(folder / "all/run.json"))["state_hash"]);
}

TEST_CASE("Runs of different scenes and commands do not share a default folder", "[tools]") {
    const program::Folder folder;
    const std::string program = "cd " + (folder / "").string() + " && " GLOBULAR_PROGRAM " ";
    const std::string tiny = " --frames 0 --size 64x36 --quality draft --quiet";
    for (const char* scene : {"honey", "hard/honey"}) {
        CHECK(program::shell(program + "render " + scene + tiny).code == 0);
        CHECK(program::shell(program + "simulate " + scene + " --frames 0 --quiet").code == 0);
    }
    fs::create_directory(folder / "mine");
    std::ofstream(folder / "mine/dust.toml")
        << "title = \"dust\"\nduration = 1\n[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\n";
    CHECK(program::shell(program + "render mine/dust.toml" + tiny).code == 0);
    for (const char* name : {"honey", "hard/honey", "dust"})
        CHECK(fs::exists(folder / "out" / name / "frame-00000.png"));
    for (const char* name : {"honey-states", "hard/honey-states"})
        CHECK(fs::exists(folder / "out" / name / "particles-00000.ply"));
}

TEST_CASE("globular video makes the same video of the frames, and refuses a gap", "[tools]") {
    const program::Folder folder;
    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    for (const char* foreign : {"frame--0001.png", "frame-99999999999.png", "frame-00001.jpg"})
        std::ofstream(folder / "a" / foreign) << "no frame";
    REQUIRE(run("video " + (folder / "a").string() + " --quiet -o " + (folder / "again.mp4").string()).code == 0);
    CHECK(textOf(folder / "again.mp4") == textOf(folder / "a.mp4"));
    fs::remove(folder / "a/frame-00004.png");
    const auto gap = run("video " + (folder / "a").string() + " -o " + (folder / "gap.mp4").string());
    CHECK(gap.code == 1);
    CHECK(gap.err.find("frame-00004.png") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "gap.mp4"));
}

TEST_CASE("A limit on the size of files is an error like a full disk", "[tools]") {
    const program::Folder folder;
    // 2 blocks of 512 bytes are less than a frame or a video takes, and enough for the messages.
    const std::string limited = "ulimit -f 2; " GLOBULAR_PROGRAM " ";
    // Several times, because the write fails at another moment of what the other stages do each time, which they must
    // bring to its end.
    for (int k = 0; k < 8; ++k) {
        const auto frames =
            program::shell(limited + "render measured/liquid --size 320x180 --frames 0-1 --threads 4 --quiet -o " +
                           (folder / "limited").string());
        INFO(frames.err);
        CHECK(frames.code == 1);
        CHECK(program::lineCount(frames.err) == 1);
        CHECK(frames.err.find("frame-00000.png: File too large") != std::string::npos);
    }
    for (const auto& entry : fs::directory_iterator(folder / "limited")) CHECK(entry.path().extension() != ".partial");

    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    const auto video = program::shell(limited + "video " + (folder / "a").string() + " --quiet -o " +
                                      (folder / "limited.mp4").string());
    INFO(video.err);
    CHECK(video.code == 1);
    CHECK(program::lineCount(video.err) == 1);
    CHECK(video.err.find("ffmpeg ended with signal 25") != std::string::npos);
    for (const auto& entry : fs::directory_iterator(folder / "")) CHECK(entry.path().extension() != ".partial");
}

TEST_CASE("A folder for temporary files that is not there is named, and the system's is used", "[tools]") {
    const program::Folder folder;
    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    const std::string video = (folder / "a.mp4").string();
    for (const std::string& arguments :
         {fountainRun(folder / "b", ""), "compare " + video + " " + video + " --quiet"}) {
        INFO(arguments);
        const std::string missing = (folder / "missing").string();
        const auto outcome = run(arguments, "TMPDIR=" + missing);
        CHECK(outcome.code == 0);
        CHECK(outcome.err.find("warning: TMPDIR is \"" + missing + "\", which is no folder") != std::string::npos);
    }
    CHECK(textOf(folder / "b.mp4") == textOf(video));
}

TEST_CASE("A frame rate that is a fraction is kept by run.json, video and a resumed run", "[tools]") {
    const program::Folder folder;
    const std::string ntsc =
        "render measured/fountain --size 64x36 --quality draft --quiet --checkpoint 0 "
        "--set fps=30000/1001 --frames 0-4 -o " +
        (folder / "a").string() + " --video " + (folder / "a.mp4").string();
    REQUIRE(run(ntsc).code == 0);
    const auto json = nlohmann::json::parse(textOf(folder / "a/run.json"));
    CHECK(json["fps"] == "30000/1001");
    const std::string video = "video " + (folder / "a").string() + " --quiet -o " + (folder / "again.mp4").string();
    REQUIRE(run(video).code == 0);
    CHECK(textOf(folder / "again.mp4") == textOf(folder / "a.mp4"));
    REQUIRE(run(video + " --fps 30").code == 0);
    CHECK(textOf(folder / "again.mp4") != textOf(folder / "a.mp4"));
    REQUIRE(run(video + " --fps 60000/2002").code == 0);
    CHECK(textOf(folder / "again.mp4") == textOf(folder / "a.mp4"));
    for (const char* wrong : {"29.97", "0", "241", "1/2", "30/0", "ntsc"}) {
        const auto outcome = run(video + " --fps " + wrong);
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "error: --fps " + std::string(wrong) +
                                 ": must be a whole number or a fraction such as 30000/1001, from 1 to 240\n");
    }
    const std::string frame = textOf(folder / "a/frame-00004.png");
    fs::remove(folder / "a/frame-00004.png");
    REQUIRE(run(ntsc + " --resume").code == 0);
    CHECK(nlohmann::json::parse(textOf(folder / "a/run.json"))["resumed_from"] == 3);
    CHECK(textOf(folder / "a/frame-00004.png") == frame);
}

TEST_CASE("globular simulate writes states that a scene can start from", "[tools]") {
    const program::Folder folder;
    REQUIRE(run("simulate measured/powder --frames 0-3 --quiet -o " + (folder / "states").string()).code == 0);
    CHECK(fs::exists(folder / "states/particles-00003.ply"));
    std::ofstream(folder / "again.toml")
        << "title = \"again\"\nduration = 0.1\n[material]\npreset = \"powder\"\nmass = 0.1\n"
           "[[body]]\nshape = \"file\"\nfile = \"states/particles-00003.ply\"\nmaterial = \"powder\"\n";
    const auto check = run("check --json " + (folder / "again.toml").string());
    INFO(check.err);
    CHECK(check.code == 0);
    const auto written = nlohmann::json::parse(textOf(folder / "states/run.json"));
    CHECK(written["particles"] > 2 * 19);  // the first layer of both nozzles and part of the second
    CHECK(nlohmann::json::parse(check.out)["particles_at_start"] == written["particles"]);
}

TEST_CASE("Error estimates with a fixed step cost at most a tenth of the run, and are counted", "[tools]") {
    const program::Folder folder;
    // A frame takes four steps of 0.01 s. A sample takes at least one of them at this length and at half of it.
    const auto [frames, samples] = GENERATE(std::pair{0, 0}, std::pair{5, 0}, std::pair{9, 1}, std::pair{60, 6});
    INFO(frames << " frames");
    const std::string range = "simulate figure-2 --quiet --frames 0-" + std::to_string(frames);
    REQUIRE(run(range + " -o " + (folder / "states").string()).code == 0);
    const auto json = nlohmann::json::parse(textOf(folder / "states/run.json"));
    const double spent = json["steps"]["force_evaluations_of_error_estimates"];
    INFO(json["steps"].dump() << " " << spent);
    CHECK(spent <= 0.1 * (json["steps"]["force_evaluations"].get<double>() - spent));
    CHECK(json["error_estimate"].is_null() == (samples == 0));
    if (samples > 0) {
        CHECK(json["error_estimate"]["samples"] == samples);
        CHECK(spent >= 3.0 * samples);
        CHECK(json["error_estimate"]["force_evaluations_spent"] == spent);
    }

    REQUIRE(run(range + " --no-error-estimate -o " + (folder / "bare").string()).code == 0);
    const auto bare = nlohmann::json::parse(textOf(folder / "bare/run.json"));
    CHECK(bare["error_estimate"].is_null());
    CHECK(bare["steps"]["force_evaluations_of_error_estimates"] == 0);
    CHECK(bare["state_hash"] == json["state_hash"]);
    CHECK(run("simulate --help").out.find("error is estimated at up to 8 frames") != std::string::npos);
}

TEST_CASE("The automatic stepper's comparisons are counted among its force evaluations", "[tools]") {
    const program::Folder folder;
    REQUIRE(run("simulate measured/liquid --quiet --frames 0-5 -o " + (folder / "states").string()).code == 0);
    const auto json = nlohmann::json::parse(textOf(folder / "states/run.json"));
    const double spent = json["steps"]["force_evaluations_of_error_estimates"];
    CHECK(spent > 0.0);
    CHECK(spent < json["steps"]["force_evaluations"].get<double>());
}

TEST_CASE("globular strip puts the frames of its times side by side", "[tools]") {
    const program::Folder folder;
    const std::string scene = "figure-2 --size 120x80 --quiet ";
    REQUIRE(run("strip " + scene + "--times 0.2,0.4,0.81 -o " + (folder / "strip.png").string()).code == 0);
    REQUIRE(run("render " + scene + "--frames 5-20 -o " + (folder / "frames").string()).code == 0);
    const auto imageOf = [](const fs::path& path) { return render::decodePng(tools::readFile(path), path.string()); };
    const render::Image strip = imageOf(folder / "strip.png");
    const int gap = (strip.width - 3 * 120) / 2;
    int panel = 0;
    // At 25 frames a second: 0.2 s is frame 5, 0.4 s frame 10, and 0.81 s nearest to frame 20.
    for (const char* name : {"frames/frame-00005.png", "frames/frame-00010.png", "frames/frame-00020.png"}) {
        const render::Image frame = imageOf(folder / name);
        const int left = panel++ * (120 + gap);
        for (int y = 0; y < 80; ++y) {
            const auto from = strip.rgb.begin() + 3 * (y * strip.width + left);
            CHECK(std::equal(from, from + 360, frame.rgb.begin() + 360 * y));
        }
    }
}

TEST_CASE("The times of a strip are checked like the scene's own", "[tools]") {
    const program::Folder folder;
    const std::string strip = "strip figure-2 --size 64x48 -o " + (folder / "strip.png").string();
    const auto late = run(strip + " --times 0.2,99");
    CHECK(late.code == 2);
    CHECK(late.err ==
          "error: --times 0.2,99: strip[1] is 99, must be at most the duration, 16 (seconds)\n");  // not --set
    CHECK(run(strip + " --times 1,0.5").code == 2);
    CHECK(run(strip + " --times soon").code == 2);
    CHECK(!fs::exists(folder / "strip.png"));
    const std::string lines = run(strip + " --times 0.08,0.2 --json").out;
    REQUIRE(program::lineCount(lines) == 3);  // one for each panel, and the result
    const auto last = nlohmann::json::parse(lines.substr(lines.rfind('\n', lines.size() - 2) + 1));
    CHECK(last["times"] == nlohmann::json::array({0.08, 0.2}));
}

TEST_CASE("Panels carry their scales once and no time stamp of their own", "[tools]") {
    const program::Folder folder;
    // Nothing moves, so that the panels differ only in their overlays.
    std::ofstream(folder / "still.toml")
        << "title = \"still\"\nduration = 1\n[physics]\ngravity = [0, 0, 0]\n[[body]]\nshape = \"points\"\n"
           "positions = [[0, 50, 0]]\n[look]\nsize = [320, 240]\ncolor_by = \"speed\"\n"
           "[overlay]\ntime = true\nscale_bar = 1\ncolor_bar = true\n";
    REQUIRE(run("strip " + (folder / "still.toml").string() + " --times 0.2,0.5,0.8 --quiet -o " +
                (folder / "strip.png").string())
                .code == 0);
    const render::Image strip = render::decodePng(tools::readFile(folder / "strip.png"), "strip.png");
    const int gap = (strip.width - 3 * 320) / 2;
    // Counts the pixels that differ from the middle panel, in the left or right half of a panel, in the rows of the
    // time stamp or below them.
    const auto different = [&](int panel, bool right, bool lower) {
        int count = 0;
        for (int y = lower ? 60 : 0; y < (lower ? 240 : 60); ++y)
            for (int x = right ? 160 : 0; x < (right ? 320 : 160); ++x) {
                const auto at = [&](int number) {
                    return strip.rgb.begin() + 3 * (y * strip.width + number * (320 + gap) + x);
                };
                count += std::equal(at(panel), at(panel) + 3, at(1)) ? 0 : 1;
            }
        return count;
    };
    for (const int panel : {0, 2})
        for (const bool right : {false, true}) CHECK(different(panel, right, false) == 0);
    CHECK(different(0, false, true) > 50);
    CHECK(different(0, true, true) == 0);
    CHECK(different(2, false, true) == 0);
    CHECK(different(2, true, true) > 500);
}

TEST_CASE("--json prints one object a line", "[tools]") {
    const program::Folder folder;
    const auto outcome = run("render figure-1 --size 64x64 --frames 1,3-4 --json -o " + (folder / "a").string());
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "");
    std::istringstream lines(outcome.out);
    nlohmann::json last;
    std::map<std::string, std::vector<int>> frames;  // by event
    for (std::string line; std::getline(lines, line);) {
        last = nlohmann::json::parse(line);
        if (last.contains("frame")) frames[last["event"]].push_back(last["frame"]);
    }
    CHECK(frames["frame"] == std::vector<int>{1, 3, 4});
    CHECK(frames["simulated"] == std::vector<int>{0, 2});
    CHECK(last["event"] == "done");
    CHECK(last["run"]["frames"] == 3);
}

TEST_CASE("Blur is drawn in final quality, warned of in others, and told by check", "[tools]") {
    const program::Folder folder;
    const std::string path = (folder / "fall.toml").string();
    std::ofstream(path)
        << "title = \"t\"\nduration = 1\n[material]\nradius = 0.2\n[[body]]\nshape = \"ball\"\n"
           "radius = 0.5\nvelocity = [5, 0, 0]\n[camera]\nshutter = 0.5\naperture = 0.25\nsamples = 16\n";
    const auto draw = [&](const std::string& name, const std::string& more) {
        return run("render " + path + " --size 64x64 --frames 2 --quiet -o " + (folder / name).string() + " " + more);
    };
    const auto normal = draw("normal", "");
    CHECK(normal.code == 0);
    CHECK(normal.err.find(path + ":10:11: shutter = 0.5 blurs pictures of --quality final alone") != std::string::npos);
    CHECK(normal.err.find(path + ":11:12: aperture = 0.25 blurs pictures of --quality final alone") !=
          std::string::npos);
    CHECK(draw("strict", "--strict").code == 2);
    const auto final = draw("final", "--quality final --strict");
    CHECK(final.code == 0);
    CHECK(final.err == "");
    CHECK(draw("sharp", "--quality final --set camera.shutter=0 --set camera.aperture=0").code == 0);
    CHECK(draw("plain", "--set camera.shutter=0 --set camera.aperture=0").err == "");
    const auto frame = [&](const std::string& name) { return textOf(folder / name / "frame-00002.png"); };
    CHECK(frame("final") != frame("sharp"));
    CHECK(frame("normal") == frame("plain"));
    CHECK(run("check " + path)
              .out.find("blur       shutter 0.5, aperture 0.25 m; with --quality final only, 16 samples") !=
          std::string::npos);
    CHECK(run("check measured/liquid").out.find("blur") == std::string::npos);
}

TEST_CASE("Every command explains itself with an example", "[tools]") {
    for (const char* command : {"render", "strip", "simulate", "mesh", "figures", "video", "compare", "approve",
                                "check", "scenes", "schema"}) {
        const auto help = run(std::string(command) + " --help");
        INFO(command);
        CHECK(help.code == 0);
        CHECK(help.out.find(std::string("Example: globular ") + command) != std::string::npos);
    }
    CHECK(run("--version").out.rfind("globular ", 0) == 0);
    CHECK(run("scenes").out.find("figure-4") != std::string::npos);
    CHECK(run("schema").out.find("metaball_reach") != std::string::npos);
}
