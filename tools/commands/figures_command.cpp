// globular figures: draws the paper's figures as stills, strips and videos, and writes one page that shows them.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "engine/stepping/take_step.h"
#include "render/opengl/context/device.h"
#include "render/output/png.h"
#include "tools/commands/commands.h"
#include "tools/pages/figures_page.h"
#include "tools/run/render_loop.h"
#include "tools/run/stills.h"
#include "tools/system/command_files.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// The renderer that draws the figures without --renderer: OpenGL, as in the paper, where the build has OSMesa.
const char* figuresRenderer() {
    return kRendererNames[render::isInBuild(render::Backend::osmesa) ? 1 : 0];
}

struct FiguresOptions {
    RunOptions run;
    DrawOptions draw;  ///< drawing options, of which only those of the renderer are used
    std::string folder = "out/figures";
    std::vector<int> numbers;
};

/// Draws the still picture of a figure and its strip of pictures in the best quality.
void drawPictures(const scenes::Scene& scene, const FiguresOptions& options, const FigureEntry& entry) {
    DrawJob job = drawJob(scene, options.draw, options.run, fmt::format("figure {} pictures", entry.number));
    job.quality = render::Quality::final;
    const StillPictures pictures = drawStills(job, {scenes::stillFrame(scene), scenes::stripFrames(scene)});
    writeFile(entry.stillPath, render::encodePng(pictures.still));
    writeFile(entry.stripPath, render::encodePng(pictures.strip));
}

FinishedRun renderVideo(const scenes::Scene& scene, const FiguresOptions& options, const FigureEntry& entry) {
    const RenderJob job{drawJob(scene, options.draw, options.run, fmt::format("figure {}", entry.number)),
                        frameList("", scenes::frameCount(scene)), std::nullopt, entry.videoPath};
    FinishedRun result = renderFrames(job);
    if (!result.report.unstable.empty()) throw engine::InstabilityError(result.report.unstable);
    return result;
}

/// The columns of the paper's Table 1 and everything else that determines the motion, in one line.
std::string constantsOf(const scenes::Scene& scene, std::size_t particleCount) {
    const engine::Material& m = scene.setup.materials.front();
    return fmt::format(
        "{} particles, r = {} m, m = {} kg, b1 = {} N m^4, b_d = {} kg/s, c_r = {}, c_d = {}, {} at {} s",
        particleCount, m.radius, m.mass, m.repulsion, m.damping, m.repulsionReach, m.dampingReach,
        engine::nameOf(scene.setup.stepper), scene.setup.step);
}

FigureEntry makeFigure(int number, const FiguresOptions& options) {
    const std::string name = fmt::format("figure-{}", number);
    const scenes::Scene scene = load({name, {}, {}});
    const fs::path folder = options.folder;
    FigureEntry entry;
    entry.number = number;
    entry.title = scene.title;
    entry.description = scene.description;
    entry.stillPath = (folder / (name + ".png")).string();
    entry.videoPath = (folder / (name + ".mp4")).string();
    entry.stripPath = (folder / fmt::format("strip-{}.png", number)).string();
    for (const int frame : scenes::stripFrames(scene)) entry.stripTimes.push_back(scenes::frameTime(scene, frame));
    entry.stillTime = scenes::frameTime(scene, scenes::stillFrame(scene));
    for (const scenes::EffectiveValue& value : scene.values) {
        if (value.origin == scenes::ValueOrigin::schemaDefault) continue;
        entry.parameters.emplace_back(value.path, value.unit.empty() ? value.toml : value.toml + " " + value.unit);
    }
    entry.command =
        fmt::format("globular render {0} -o out/{0} --video out/{0}.mp4{1}", name, drawFlags(options.draw));

    drawPictures(scene, options, entry);
    FinishedRun result = renderVideo(scene, options, entry);
    entry.stateHash = result.report.stateHash;
    entry.constants = constantsOf(scene, result.simulation.particles.count());
    writeFile(folder / (name + ".json"), indentedText(runJson(scene, result)));
    return entry;
}

void makeFigures(const FiguresOptions& options) {
    requireSeparate(
        {{}, {}, {{"-o", options.folder, [](const fs::path& file) { return file.filename() == "index.html"; }}}});
    createFolder(options.folder);
    std::vector<FigureEntry> entries;
    for (const int number : options.numbers) {
        entries.push_back(makeFigure(number, options));
        const FigureEntry& entry = entries.back();
        printResult(options.run,
                    {{"event", "figure"},
                     {"figure", number},
                     {"still", entry.stillPath},
                     {"strip", entry.stripPath},
                     {"video", entry.videoPath},
                     {"state_hash", entry.stateHash}},
                    fmt::format("figure {}: {}, {}, {}\n", number, entry.stillPath, entry.stripPath, entry.videoPath));
    }
    const fs::path page = fs::path(options.folder) / "index.html";
    writeFile(page, figuresPage(entries));
    if (options.run.verbosity() == Verbosity::normal) printText(fmt::format("all of it: {}\n", page.string()));
}

}  // namespace

void addFiguresCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("figures", "the paper's figures: stills, strips, videos, and a page that shows them");
    const auto options = std::make_shared<FiguresOptions>();
    command.add_option("FIGURE", options->numbers, "which figures (default: all four)")->check(CLI::Range(1, 4));
    command.add_option("-o,--output", options->folder, "folder to write to (default: out/figures)")->type_name("DIR");
    options->draw.renderer = figuresRenderer();
    addRendererFlags(command, options->draw);
    addTo(command, options->run);
    command.footer("Example: globular figures 1 3 -o out/figures");
    command.callback([options] {
        if (options->numbers.empty()) options->numbers = {1, 2, 3, 4};
        makeFigures(*options);
    });
}

}  // namespace tools
