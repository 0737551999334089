// globular strip: draws a scene at several times, side by side in one picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "render/output/png.h"
#include "render/output/video.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/run/stills.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct StripOptions {
    RunOptions run;
    SceneOptions scene;
    DrawOptions draw;
    std::string times;
    std::string output;
};

/// Loads the scene; the times of --times, if they are given, replace those of its strip.
scenes::Scene loadScene(const StripOptions& options) {
    scenes::Overrides overrides = overridesOf(options.draw);
    if (!options.times.empty())
        overrides.emplace_back(fmt::format("still.strip=[{}]", options.times), "--times " + options.times);
    return load(options.scene, overrides);
}

void checkOutput(const fs::path& path, const scenes::Scene& scene) {
    if (render::videoKindOf(path.string()) != render::VideoKind::png)
        throw scenes::InputError("-o " + path.string(), "a strip is a PNG, so its name must end in .png");
    requireSeparate({scene.files, {{"-o", path}}, {}});
}

void drawStrip(const StripOptions& options) {
    const scenes::Scene scene = loadScene(options);
    const DrawJob job = drawJob(scene, options.draw, options.run, runName(options.scene));
    warnOfSharpness(options.scene, job);
    const fs::path path = options.output.empty() ? defaultOutput(job.title, "-strip.png") : options.output;
    const bool isPiped = path == kStandardStream;
    if (isPiped)
        requirePipedOutput(options.run);
    else
        checkOutput(path, scene);

    const std::vector<int> frames = scenes::stripFrames(scene);
    const StillPictures pictures = drawStills(job, {std::nullopt, frames});
    if (isPiped) return writeStandardOutput(render::encodePng(pictures.strip));
    createFolderOf(path);
    writeFile(path, render::encodePng(pictures.strip));
    Json json{{"event", "done"}, {"strip", path.string()}, {"times", Json::array()}};
    for (const int frame : frames) json["times"].push_back(scenes::frameTime(scene, frame));
    json["state_hash"] = pictures.stateHash;
    printResult(options.run, json, fmt::format("{} panels in {}\n", frames.size(), path.string()));
}

}  // namespace

void addStripCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("strip", "a scene at several times, side by side in one picture");
    const auto options = std::make_shared<StripOptions>();
    addTo(command, options->scene);
    command.add_option("--times", options->times, "times in seconds (default: the scene's still.strip)")
        ->type_name("T,T,...");
    command
        .add_option("-o,--output", options->output,
                    "the picture to write, - for standard output (default: out/NAME-strip.png)")
        ->type_name("FILE.png");
    addTo(command, options->draw);
    addTo(command, options->run);
    command.footer("Example: globular strip liquid --times 0.5,1,2 --size 480x270 -o out/liquid.png");
    command.callback([options] { drawStrip(*options); });
}

}  // namespace tools
