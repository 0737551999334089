// The render loop's pipeline, in which frames are simulated, drawn and encoded at the same time: its files are the same
// on one thread and on several. The preset "tsan" runs it under ThreadSanitizer, which reports what two of the stages
// touch without being ordered; that is what this suite is for.
#include <filesystem>
#include <map>

#include "scenes/build/read_scene.h"
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"
#include "tools/run/render_loop.h"
#include "tools/system/output_file.h"

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;
using scenes_test::ScratchFolder;

const tools::FrameList kFrames = {{0, 1, 2, 3, 4, 5}};

// Everything that the stages hand over or share: a moving camera, overlays, births and deaths, shadows, ambient
// occlusion, an obstacle; more particles than engine::kParticleGrain, so that the engine's loops are shared out, too.
constexpr const char* kScene = R"(
title = "Pipeline"
duration = 1
fps = 30

[physics]
stepper = "velocity-verlet"
step = 0.0166

[world]
minimum = [-3, -1, -3]

[[body]]
shape = "box"
minimum = [-1.2, 0.2, -1.2]
maximum = [1.2, 2.6, 1.2]
spacing = 0.25

[[emitter]]
position = [0, 4, 0]
velocity = [0, -4, 0]
interval = 0.02

[[obstacle]]
shape = "sphere"
center = [0.2, -0.5, 0]
radius = 0.5

[[camera]]
time = 0
eye = [4, 3, 8]
target = [0, 1, 0]

[[camera]]
time = 1
eye = [-4, 3, 8]

[look]
color_by = "speed"
occlusion = 1
ground = true

[overlay]
time = true
)";

scenes::Scene sceneOf(const std::string& style) {
    return scenes::readScene(kScene, "pipeline.toml", {"look.style=" + style, "look.size=[96, 54]"});
}

tools::RenderJob jobOf(const scenes::Scene& scene, const ScratchFolder& folder, int threads) {
    tools::RenderJob job;
    job.scene = &scene;
    job.frames = kFrames;
    job.folder = tools::FolderOptions{.path = (folder.path / "frames").string(), .checkpointSeconds = 0.0};
    job.videoPath = (folder.path / "video.mp4").string();
    job.threads = threads;
    job.verbosity = tools::Verbosity::normal;  // the thread that shows the progress looks at what the stages change
    return job;
}

/// The bytes of a run's frames and of its video, by name.
std::map<std::string, Bytes> picturesIn(const ScratchFolder& folder) {
    std::map<std::string, Bytes> pictures = {{"video.mp4", tools::readFile(folder.path / "video.mp4")}};
    for (const auto& file : fs::directory_iterator(folder.path / "frames"))
        if (file.path().extension() == ".png") pictures[file.path().filename().string()] = tools::readFile(file.path());
    return pictures;
}

}  // namespace

TEST_CASE("A run on several threads leaves the files of a run on one", "[pipeline][threads]") {
    const std::string style = GENERATE("spheres", "metaballs");
    INFO(style);
    const scenes::Scene scene = sceneOf(style);
    const ScratchFolder alone;
    const ScratchFolder together;
    const auto one = tools::renderFrames(jobOf(scene, alone, 1));
    const auto several = tools::renderFrames(jobOf(scene, together, 4));
    CHECK(one.simulation.particles.count() > 1024);
    CHECK(several.report.stateHash == one.report.stateHash);
    const auto expected = picturesIn(alone);
    REQUIRE(expected.size() == 7);  // six frames and the video
    CHECK(picturesIn(together) == expected);

    // Frames that are kept are read again while others are drawn.
    for (const char* name : {"frame-00002.png", "frame-00004.png"}) fs::remove(together.path / "frames" / name);
    tools::RenderJob again = jobOf(scene, together, 4);
    again.folder->resume = true;
    tools::renderFrames(again);
    CHECK(picturesIn(together) == expected);
}
