// globular study pictures: what frames cost, stage by stage, and how far they are from the exact picture.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "scenes/text/input_error.h"
#include "studies/pictures/pictures.h"
#include "tools/commands/commands.h"
#include "tools/pages/pictures_page.h"
#include "tools/run/scene_options.h"
#include "tools/system/gnuplot.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/standard_streams.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct PicturesOptions {
    RunOptions run;
    std::string folder = "out/study-pictures";
    bool quick = false;
    std::vector<std::size_t> particles;
    std::string size;  ///< WxH
};

render::PictureSize sizeOf(const std::string& text) {
    render::PictureSize size{0, 0};
    char rest = 0;
    const bool whole = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) == 2;
    // The windows of the error lie side by side.
    if (!whole || size.width < 256 || size.height < 144 || size.width > 8192 || size.height > 8192)
        throw scenes::InputError(
            {{"--size", 0, 0, fmt::format("{} must be WxH from 256x144 to 8192x8192 pixels", text)}});
    return size;
}

studies::PictureSettings settingsFor(const PicturesOptions& options) {
    studies::PictureSettings settings;
    settings.videoPath = (fs::path(options.folder) / "timing.mp4").string();
    if (options.quick) {
        settings.particles = {2000, 10000};
        settings.sizes = {{640, 360}};
        settings.frames = 3;
        settings.encodedFrames = 4;
        settings.windowColumns = 3;
        settings.windowRows = 2;
        settings.samplesPerAxis = 2;
    }
    if (!options.particles.empty()) settings.particles = options.particles;
    if (!options.size.empty()) settings.sizes = {sizeOf(options.size)};
    return settings;
}

studies::FlickerSettings flickerSettingsFor(const PicturesOptions& options) {
    studies::FlickerSettings settings;
    if (options.quick) {
        settings.particles = 2000;
        settings.size = {320, 180};
        settings.frames = 3;
    }
    return settings;
}

void tellRow(const studies::PictureRow& row, Verbosity verbosity) {
    if (verbosity == Verbosity::json)
        printJson(Json{{"event", "row"},
                       {"style", studies::nameOf(row.style)},
                       {"particles", row.particles},
                       {"width", row.size.width},
                       {"quality", studies::nameOf(row.quality)},
                       {"seconds", row.draw},
                       {"ratio", row.ratio()},
                       {"ratio_at_rest", row.ratioAtRest()},
                       {"ratio_to_fewest", row.ratioToFewest()},
                       {"ssim", row.error.ssim}});
    else if (verbosity == Verbosity::normal)
        printToStderr(fmt::format("{} {} {}x{} {}: {:.4g} ms, {:.2f} of the quads' {:.4g} ms, SSIM {:.5f}\n",
                                  studies::nameOf(row.style), row.particles, row.size.width, row.size.height,
                                  studies::nameOf(row.quality), 1e3 * row.draw, row.ratio(), 1e3 * row.baseline,
                                  row.error.ssim));
}

/// Writes a table after each of its rows: the study takes long, and what interrupts it leaves what was measured.
PictureResults measure(const PicturesOptions& options, const studies::PictureSettings& settings) {
    const fs::path folder = options.folder;
    PictureResults results;
    results.rows = studies::measurePictures(settings, [&](const std::vector<studies::PictureRow>& rows) {
        writeFile(folder / "pictures.csv", studies::picturesCsv(rows));
        tellRow(rows.back(), options.run.verbosity());
    });
    results.flicker =
        studies::measureFlicker(flickerSettingsFor(options), [&](const std::vector<studies::FlickerRow>& rows) {
            writeFile(folder / "flicker.csv", studies::flickerCsv(rows));
        });
    results.smoothing = studies::measureSmoothing({settings.particles, settings.sizes.front(), settings.frames},
                                                  [&](const std::vector<studies::SmoothingRow>& rows) {
                                                      writeFile(folder / "skins.csv", studies::smoothingCsv(rows));
                                                  });
    return results;
}

void print(const std::vector<studies::PictureRow>& rows) {
    fmt::print("{:9} {:>9} {:>9} {:7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>6} {:>8} {:>9} {:>9} {:>8} {:>9}\n", "style",
               "particles", "size", "quality", "frame, ms", "rest, ms", "+PNG, ms", "+MP4, ms", "quads, ms", "ratio",
               "at rest", "to fewest", "RMSE", "SSIM", "wrong, %");
    for (const studies::PictureRow& row : rows)
        fmt::print(
            "{:9} {:>9} {:>9} {:7} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>6.2f} {:>8.2f} {:>9.2f} {:>9.3f} "
            "{:>8.5f} {:>9.4f}\n",
            studies::nameOf(row.style), row.particles, fmt::format("{}x{}", row.size.width, row.size.height),
            studies::nameOf(row.quality), 1e3 * row.draw, 1e3 * row.atRest, 1e3 * row.withPng, 1e3 * row.withMp4,
            1e3 * row.baseline, row.ratio(), row.ratioAtRest(), row.ratioToFewest(), row.error.rmse, row.error.ssim,
            100.0 * row.error.wrongHits);
}

void study(const PicturesOptions& options) {
    const int threads = threadCount(options.run);
    ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);
    const fs::path folder = options.folder;
    createFolder(folder);
    const studies::PictureSettings settings = settingsFor(options);
    PictureResults results;
    onThreads(threads, [&] { results = measure(options, settings); });
    const std::vector<studies::PictureRow>& rows = results.rows;
    fs::remove(settings.videoPath);
    const PicturePlots plots{drawPlot(studies::pictureTimesPlot(rows, results.smoothing)),
                             drawPlot(studies::pictureErrorsPlot(rows))};
    writeFile(folder / "times.svg", plots.times);
    writeFile(folder / "errors.svg", plots.errors);
    std::string command = fmt::format("globular study pictures{}", options.quick ? " --quick" : "");
    if (!options.particles.empty()) command += fmt::format(" --particles {}", fmt::join(options.particles, " "));
    if (!options.size.empty()) command += " --size " + options.size;
    command += fmt::format(" --threads {}", threads);
    writeFile(folder / "index.html", picturesPage(results, plots, command));
    if (options.run.verbosity() != Verbosity::normal) return;
    print(rows);
    for (const studies::FlickerRow& row : results.flicker)
        fmt::print("{} {}, {} particles, {}x{}: camera moving, change {:.3f}, jerk {:.3f} steps of 255\n",
                   studies::nameOf(row.style), studies::nameOf(row.quality), row.particles, row.size.width,
                   row.size.height, row.change, row.jerk);
    for (const studies::SmoothingRow& row : results.smoothing)
        fmt::print("{} skin, {} particles: {:.4g} ms, volume {:.3f}, bumps {:.2f} degrees\n", studies::nameOf(row.skin),
                   row.particles, 1e3 * row.draw, row.volume, row.bumps);
    fmt::print("all of it: {}\n", (folder / "index.html").string());
}

}  // namespace

void addStudyPictures(const Command& study) {
    const Command command =
        study.command("pictures", "time of each stage of a frame, and its error against the exact picture");
    const auto options = std::make_shared<PicturesOptions>();
    command.option("-o,--output", options->folder, "folder to write to (default: out/study-pictures)").of("DIR");
    command.option("--particles", options->particles, "how many (default: 2000 10000 50000 200000)")
        .within(100, 10000000)
        .of("N");
    command.option("--size", options->size, "of the picture (default: 1280x720 and 1920x1080)").of("WxH");
    command.flag("--quick", options->quick, "fewer particles, small pictures");
    addTo(command, options->run);
    command.example("globular study pictures --quick -o out/pictures");
    command.run([options] { tools::study(*options); });
}

}  // namespace tools
