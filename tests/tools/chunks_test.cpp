// Tests runs that are shared out in chunks: together they leave what one run of all frames leaves, byte for byte,
// whatever happens to one of them, and `assemble` notices what is not whole.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "scenes/text/input_error.h"
#include "tests/catch.h"
#include "tests/tools/moving_scene.h"
#include "tests/tools/program.h"
#include "tools/frames/chunk.h"
#include "tools/frames/frame_names.h"
#include "tools/frames/joined_frames.h"
#include "tools/system/processors.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 20;  // of the scene

std::map<std::string, std::string> slurm;

const char* variable(const char* name) {
    const auto found = slurm.find(name);
    return found == slurm.end() ? nullptr : found->second.c_str();
}

std::string problemOf(const std::string& chunk) {
    try {
        tools::parseChunk(chunk, variable);
    } catch (const scenes::InputError& error) {
        return error.what();
    }
    return "no error";
}

ino_t inodeOf(const fs::path& file) {
    struct stat status = {};
    REQUIRE(::stat(file.c_str(), &status) == 0);
    return status.st_ino;
}

/// Runs of a scene in chunks.
struct Chunks : program::MovingScene {
    fs::path out = folder / "out";

    std::string draw(const std::string& chunk, const std::string& more = "") const {
        return fromStates("out", "--threads 1 --chunk " + chunk + " " + more);
    }
    program::Outcome assemble(const std::string& more = "") const {
        return run("assemble " + out.string() + " " + more);
    }
    fs::path picture(int frame) const { return out / tools::kPictureNames.fileName(frame); }
    std::set<std::string> names() const {
        std::set<std::string> all;
        for (const auto& entry : fs::directory_iterator(out)) all.insert(entry.path().filename().string());
        return all;
    }
};

}  // namespace

TEST_CASE("A chunk is given by its number or by the task of a job array", "[chunks]") {
    using tools::Chunk;
    const auto chunk = [](const char* text) { return tools::parseChunk(text, variable); };
    slurm.clear();
    CHECK(chunk("1/1") == Chunk{1, 1, {}});
    CHECK(chunk("3/4") == Chunk{3, 4, {}});
    CHECK(problemOf("0/4") == "--chunk 0/4: there are chunks 1/4 to 4/4");
    CHECK(problemOf("5/4") == "--chunk 5/4: there are chunks 1/4 to 4/4");
    for (const char* wrong : {"", "1", "/", "1/", "/2", "a/2", "1/0", "1/2/3", "automatic", "1/100001"})
        CHECK(problemOf(wrong) != "no error");
    CHECK(problemOf("auto") ==
          "--chunk auto: SLURM_ARRAY_TASK_ID is not set, so this is no task of a Slurm job array; elsewhere write "
          "--chunk "
          "I/N");
    const auto task = [&](const char* id, const char* first, const char* last, const char* step, const char* count) {
        slurm = {{"SLURM_ARRAY_TASK_ID", id},
                 {"SLURM_ARRAY_TASK_MIN", first},
                 {"SLURM_ARRAY_TASK_MAX", last},
                 {"SLURM_ARRAY_TASK_STEP", step},
                 {"SLURM_ARRAY_TASK_COUNT", count}};
    };
    task("0", "0", "3", "1", "4");
    CHECK(chunk("auto") == Chunk{1, 4, {}});
    task("4", "1", "4", "1", "4");
    CHECK(chunk("auto") == Chunk{4, 4, {}});
    task("20", "10", "30", "10", "3");
    CHECK(chunk("auto") == Chunk{2, 3, {}});
    task("3", "0", "7", "1", "3");  // --array=0,3,7
    CHECK(
        problemOf("auto") ==
        "--chunk auto: task 3 belongs to an array that is not evenly spaced from 0 to 7; with auto/N any tasks can be "
        "submitted");
    // Tasks of --array=0-3 and --array=1-4 are four chunks each, and a task alone is the chunk that it was among the
    // others.
    std::set<int> fromZero, fromOne;
    for (int id = 0; id < 4; ++id) {
        slurm["SLURM_ARRAY_TASK_ID"] = std::to_string(id);
        fromZero.insert(chunk("auto/4").index);
        slurm["SLURM_ARRAY_TASK_ID"] = std::to_string(id + 1);
        fromOne.insert(chunk("auto/4").index);
    }
    CHECK(fromZero == std::set<int>{1, 2, 3, 4});
    CHECK(fromOne == fromZero);
    slurm["SLURM_ARRAY_TASK_ID"] = "x";
    CHECK(problemOf("auto/4") == "--chunk auto/4: SLURM_ARRAY_TASK_ID is \"x\", must be a whole number >= 0");
}

TEST_CASE("Chunks interleave, and share out every frame once", "[chunks]") {
    const tools::FrameList frames{{2, 3, 5, 7, 11, 13, 17}};
    CHECK(tools::framesOf(frames, {1, 3, {}})->numbers == std::vector<int>{2, 7, 17});
    CHECK(tools::framesOf(frames, {2, 3, {}})->numbers == std::vector<int>{3, 11});
    CHECK(tools::framesOf(frames, {3, 3, {}})->numbers == std::vector<int>{5, 13});
    CHECK(tools::framesOf(frames, {7, 8, {}})->numbers == std::vector<int>{17});
    CHECK_FALSE(tools::framesOf(frames, {8, 8, {}}));
}

TEST_CASE("The files of chunks are told by their names", "[chunks]") {
    const tools::Chunk chunk{2, 14, {}};
    CHECK(tools::manifestName(chunk) == "chunk-2-of-14.json");
    CHECK(tools::checkpointPrefix(chunk) == "chunk-2-of-14-checkpoint-");
    for (const char* name : {"manifest.json", "chunk-2-of-14.json"}) CHECK(tools::isManifestName(name));
    for (const char* name : {"checkpoint-00003.state", "chunk-2-of-14-checkpoint-00003.state"})
        CHECK(tools::isCheckpointName(name));
    for (const char* name : {"chunk-0-of-4.json", "chunk-5-of-4.json", "chunk-02-of-4.json", "chunk-2-of-.json",
                             "chunk-2-of-4-checkpoint-3.state", "chunk-2-of-4checkpoint-00003.state",
                             "chunk-2-of-4.txt", "chunk-2-of-4-manifest.json", ".chunk-2-of-4.lock"})
        CHECK_FALSE(tools::isRunFile(name));
}

TEST_CASE("The kind of the processors is read from Linux's description of them", "[chunks]") {
    const program::Folder folder;
    const fs::path file = folder / "cpuinfo";
    const auto kind = [&] { return tools::processorKind(file); };
    CHECK(kind().vendor.empty());
    program::writeText(
        file, "processor\t: 0\nvendor_id\t: AuthenticAMD\nmodel name\t: A: B\n\nprocessor\t: 1\nvendor_id\t: X\n");
    CHECK(kind().vendor == "AuthenticAMD");
    CHECK(kind().model == "A: B");
    program::writeText(file, "processor\t: 0\nCPU implementer\t: 0x41\nCPU part\t: 0xd0c\n");
    CHECK(kind().vendor == "0x41");
    CHECK(kind().model == "0xd0c");
}

TEST_CASE("Chunks drawn at the same time give the frames and the film of one run", "[chunks]") {
    const Chunks scene;
    const std::string film = (scene.folder / "direct.mp4").string();
    REQUIRE(run(scene.MovingScene::draw("direct", "--video " + film)).code == 0);
    const auto outcome = program::shell(GLOBULAR_PROGRAM " " + scene.draw("1/3") + " & " GLOBULAR_PROGRAM " " +
                                        scene.draw("2/3") + " & " GLOBULAR_PROGRAM " " + scene.draw("3/3") + "; wait");
    CHECK(outcome.err.empty());
    const auto whole = scene.assemble("--print-missing");
    CHECK(whole.code == 0);
    CHECK(whole.out.empty());
    const std::string made = (scene.folder / "made.mp4").string();
    const auto assembled = scene.assemble("--quiet -o " + made);
    CHECK(assembled.err.empty());
    REQUIRE(assembled.code == 0);
    CHECK(textOf(made) == textOf(film));
    std::set<std::string> wanted = {"manifest.json", "run.json", "chunk-1-of-3.json", "chunk-2-of-3.json",
                                    "chunk-3-of-3.json"};
    for (int frame = 0; frame < kFrames; ++frame) {
        wanted.insert(tools::kPictureNames.fileName(frame));
        CHECK(scene.frame("out", frame) == scene.frame("direct", frame));
    }
    CHECK(scene.names() == wanted);
    const auto manifest = scene.json("out/manifest.json");
    CHECK(manifest["asked"] == "0-19");
    CHECK(manifest["frames"] == scene.json("direct/manifest.json")["frames"]);
    CHECK(manifest["run"] == scene.json("direct/manifest.json")["run"]);
    const auto report = scene.json("out/run.json");
    CHECK(report["state_hash"] == scene.json("direct/run.json")["state_hash"]);
    CHECK(report["frames"] == kFrames);
    CHECK(report["assembled_from"].size() == 3);
    CHECK(report["machines"].size() == 1);
    CHECK(report["renderer"] == "cpu");
    CHECK(report["drawn_from"]["states"] == scene.states);
    // What was put together is a folder as any other: `video` reads it, and a run of all frames goes on with it.
    REQUIRE(run("video " + scene.out.string() + " --quiet -o " + made).code == 0);
    CHECK(textOf(made) == textOf(film));
    const ino_t before = inodeOf(scene.picture(4));
    REQUIRE(run(scene.MovingScene::draw("out", "--resume")).code == 0);
    CHECK(inodeOf(scene.picture(4)) == before);
}

TEST_CASE("Chunks that simulate draw the same frames", "[chunks]") {
    const Chunks scene;
    REQUIRE(run(scene.MovingScene::draw("direct", "--frames 0-12:2")).code == 0);
    for (const char* chunk : {"1/2", "2/2", "9/9"}) {
        const auto outcome = run("render " + scene.file + " --size 160x90 --frames '0-12:2' --checkpoint 0 -o " +
                                 scene.out.string() + " --chunk " + chunk);
        INFO(outcome.err);
        CHECK(outcome.code == 0);
        if (chunk == std::string("9/9")) CHECK(outcome.out == "chunk 9/9 is empty: there are not so many frames\n");
    }
    CHECK(fs::exists(scene.out / "chunk-2-of-2-checkpoint-00010.state"));
    REQUIRE(scene.assemble().code == 0);
    for (int frame = 0; frame < 13; frame += 2) CHECK(scene.frame("out", frame) == scene.frame("direct", frame));
    CHECK(scene.json("out/manifest.json")["asked"] == "0-12:2");
}

TEST_CASE("Lists of frames that a render farm hands out are chunks, too", "[chunks]") {
    const Chunks scene;
    const auto draw = [&](const std::string& frames) { return scene.draw("list", "--frames '" + frames + "'"); };
    const auto outcome =
        program::shell(GLOBULAR_PROGRAM " " + draw("0-4") + " & " GLOBULAR_PROGRAM " " + draw("5, 7-9:2") + "; wait");
    CHECK(outcome.err.empty());
    CHECK(scene.assemble("--print-missing").code == 0);
    const auto missing = scene.assemble("--frames 0-9 --print-missing");
    CHECK(missing.code == 1);
    CHECK(missing.out == "6,8\n");
    CHECK(scene.assemble("--frames 0-").code == 2);
    REQUIRE(run(draw("6,8")).code == 0);
    CHECK(scene.assemble("--frames 0-9").code == 0);
    REQUIRE(run(scene.MovingScene::draw("direct", "--frames 0-9")).code == 0);
    for (int frame = 0; frame < 10; ++frame) CHECK(scene.frame("out", frame) == scene.frame("direct", frame));
    std::string_view name = "chunk-list-0123456789abcdef.json";
    CHECK(tools::isManifestName(name));
    CHECK(tools::takeChunkName(name)->list == "0123456789abcdef");
    CHECK(name == ".json");
}

TEST_CASE("A chunk that was killed is resumed, and nothing else is drawn again", "[chunks]") {
    const Chunks scene;
    REQUIRE(run(scene.MovingScene::draw("direct", "")).code == 0);
    REQUIRE(run(scene.draw("1/2")).code == 0);
    // Killed when its second frame is there. Frames that its manifest did not list yet are drawn again.
    program::shell(GLOBULAR_PROGRAM " " + scene.draw("2/2") + " & until [ -e " + scene.picture(3).string() +
                   " ]; do sleep 0.002; done; kill -9 $!; wait");
    const auto missing = scene.assemble("--print-missing");
    CHECK(missing.code == 1);
    CHECK(!missing.out.empty());
    std::map<int, ino_t> before;
    for (int frame = 0; frame < kFrames; frame += 2) before[frame] = inodeOf(scene.picture(frame));
    REQUIRE(run(scene.draw("2/2", "--resume")).code == 0);
    for (const auto& [frame, inode] : before) CHECK(inodeOf(scene.picture(frame)) == inode);
    REQUIRE(scene.assemble().code == 0);
    for (int frame = 0; frame < kFrames; ++frame) CHECK(scene.frame("out", frame) == scene.frame("direct", frame));
    CHECK(!fs::exists(scene.out / ".chunk-2-of-2.lock"));
}

TEST_CASE("What is missing or damaged is named, in the words of --frames", "[chunks]") {
    const Chunks scene;
    REQUIRE(run(scene.MovingScene::draw("direct", "")).code == 0);
    for (const char* chunk : {"1/4", "2/4", "4/4"}) REQUIRE(run(scene.draw(chunk)).code == 0);
    auto outcome = scene.assemble();
    CHECK(outcome.code == 1);
    CHECK(outcome.err == "error: 5 of 20 frames of " + scene.out.string() +
                             " are missing: 2-18:4\nerror: draw them with the command that draws the others, with "
                             "--resume\n");
    CHECK(!fs::exists(scene.out / "manifest.json"));
    fs::remove(scene.picture(4));
    std::string bytes = textOf(scene.picture(8));
    bytes[200] ^= 1;
    program::writeText(scene.picture(8), bytes);
    outcome = scene.assemble("--print-missing");
    CHECK(outcome.code == 1);
    CHECK(outcome.out == "2-10:2,14,18\n");
    CHECK(outcome.err.empty());
    const std::string missing = outcome.out.substr(0, outcome.out.size() - 1);
    CHECK(scene.assemble().err.find("1 of 20 frames of " + scene.out.string() + " are damaged: 8\n") !=
          std::string::npos);
    CHECK(nlohmann::json::parse(scene.assemble("--print-missing --json").out)["frames"] == missing);

    // In whatever parts they are drawn, only these are drawn again.
    std::map<int, ino_t> before;
    for (const int frame : {0, 1, 3, 5, 7, 9, 19}) before[frame] = inodeOf(scene.picture(frame));
    REQUIRE(run(scene.draw("1/2", "--resume")).code == 0);
    REQUIRE(run(scene.draw("1/1", "--resume --frames " + missing)).code == 0);
    for (const auto& [frame, inode] : before) CHECK(inodeOf(scene.picture(frame)) == inode);
    REQUIRE(scene.assemble().code == 0);
    for (int frame = 0; frame < kFrames; ++frame) CHECK(scene.frame("out", frame) == scene.frame("direct", frame));
}

TEST_CASE("Chunks of different runs are not put together", "[chunks]") {
    const Chunks scene;
    REQUIRE(run(scene.draw("1/2")).code == 0);
    auto outcome = run(scene.draw("2/2", "--quality draft"));
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("holds frames of another run (quality: \"normal\" there, \"draft\" here)") !=
          std::string::npos);
    CHECK(run(scene.fromStates("out", "--quality draft")).code == 1);
    // As if both had begun before the other's manifest was there.
    REQUIRE(run(scene.fromStates("draft", "--quality draft --chunk 2/2")).code == 0);
    for (const auto& entry : fs::directory_iterator(scene.folder / "draft"))
        fs::copy_file(entry.path(), scene.out / entry.path().filename());
    outcome = scene.assemble();
    CHECK(outcome.code == 1);
    CHECK(outcome.err ==
          "error: " + scene.out.string() +
              " holds frames of different runs: chunk-1-of-2.json and chunk-2-of-2.json differ (quality: "
              "\"normal\" there, \"draft\" here)\n");
    CHECK(!fs::exists(scene.out / "manifest.json"));
    CHECK(run("assemble " + scene.states).err.find("lists states, not pictures") != std::string::npos);
    CHECK(run("assemble " + (scene.folder / "").string()).err.find("holds no frames of a run") != std::string::npos);
}

TEST_CASE("A run of all frames that ended early is not whole, either", "[chunks]") {
    const Chunks scene;
    REQUIRE(run(scene.fromStates("out", "--frames 0-4")).code == 0);
    CHECK(scene.assemble().code == 0);
    // As if it had been killed: its manifest asks for more than it lists.
    std::string text = textOf(scene.out / "manifest.json");
    const std::string asked = "\"asked\": \"0-4\"";
    REQUIRE(text.find(asked) != std::string::npos);
    program::writeText(scene.out / "manifest.json", text.replace(text.find(asked), asked.size(), "\"asked\": \"0-7\""));
    CHECK(scene.assemble("--print-missing").out == "5-7\n");
    // Chunks may complete it.
    REQUIRE(run(scene.draw("1/1", "--frames 0-7 --resume")).code == 0);
    CHECK(scene.assemble().code == 0);
    CHECK(scene.json("out/manifest.json")["frames"].size() == 8);
}

TEST_CASE("A chunk removes what killed runs have left of its own frames alone", "[chunks]") {
    const Chunks scene;
    fs::create_directories(scene.out);
    for (const char* name : {".frame-00000.png.abcdef.partial", ".frame-00001.png.abcdef.partial"})
        program::writeText(scene.out / name, "x");
    REQUIRE(run(scene.draw("1/2")).code == 0);
    CHECK(!fs::exists(scene.out / ".frame-00000.png.abcdef.partial"));
    CHECK(fs::exists(scene.out / ".frame-00001.png.abcdef.partial"));
    REQUIRE(run(scene.draw("2/2")).code == 0);
    CHECK(!fs::exists(scene.out / ".frame-00001.png.abcdef.partial"));
}

TEST_CASE("Flags that make no sense for a chunk are refused", "[chunks]") {
    const Chunks scene;
    for (const char* flags : {"--overwrite", "--video x.mp4"}) CHECK(run(scene.draw("1/2", flags)).code == 2);
    CHECK(run("render " + scene.file + " --chunk 1/2 -o - | cat").err.find("--chunk are for a folder") !=
          std::string::npos);
    CHECK(run(scene.draw("3/2")).code == 2);
    CHECK(run("assemble " + scene.out.string() + " --print-missing -o x.mp4").code == 2);
    CHECK(!fs::exists(scene.out));
}

TEST_CASE("Two runs of a chunk, or a chunk and a run of all frames, do not write at the same time", "[chunks]") {
    const Chunks scene;
    fs::create_directories(scene.out);
    const fs::path lock = scene.out / ".chunk-1-of-2.lock";
    const int file = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    REQUIRE(::flock(file, LOCK_EX) == 0);
    auto outcome = run(scene.draw("1/2"));
    CHECK(outcome.code == 1);
    CHECK(outcome.err == "error: another run is writing chunk-1-of-2 into " + scene.out.string() + "\n");
    CHECK(run(scene.draw("2/2")).code == 0);
    ::close(file);
    // What a killed chunk leaves does not hold the next one up.
    CHECK(run(scene.draw("1/2")).code == 0);
    CHECK(!fs::exists(lock));

    const int folder = ::open(scene.out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    REQUIRE(::flock(folder, LOCK_SH) == 0);  // as another chunk
    CHECK(run(scene.draw("1/2", "--resume")).code == 0);
    CHECK(run(scene.fromStates("out", "--resume")).err ==
          "error: another run is writing into " + scene.out.string() + "\n");
    CHECK(scene.assemble().code == 1);
    REQUIRE(::flock(folder, LOCK_EX) == 0);  // as a run of all frames
    CHECK(run(scene.draw("1/2", "--resume")).code == 1);
    CHECK(scene.assemble("--print-missing").code == 0);  // looks on
    ::close(folder);
}

TEST_CASE("Frames of OpenGL on CPUs of different makers are warned of", "[chunks]") {
    tools::JoinedFrames joined;
    joined.manifest.identity = {{"renderer", "opengl"}};
    joined.machines = {{{"cpu_vendor", "GenuineIntel"}}, {{"cpu_vendor", "GenuineIntel"}}};
    CHECK(tools::machineWarning(joined).empty());
    joined.machines.push_back({{"cpu_vendor", "AuthenticAMD"}});
    CHECK(tools::machineWarning(joined) ==
          "the frames were drawn by OpenGL on CPUs of AuthenticAMD and GenuineIntel: their last bits may differ");
    joined.manifest.identity["renderer"] = "cpu";
    CHECK(tools::machineWarning(joined).empty());
}
