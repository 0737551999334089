// globular study pictures: measures what frames cost, stage by stage, and how far they are from the exact picture.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "render/opengl/context/context.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "studies/pictures/pictures.h"
#include "tools/commands/study/study_command.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct PicturesOptions : StudyOptions {
    std::vector<std::size_t> particles;
    DrawOptions draw;  ///< options of drawing, of which only the size and OpenGL's device are used
};

/// @throws scenes::InputError if the windows in which errors are measured would not fit side by side, or the picture is
/// too large
render::PictureSize sizeOf(const std::string& text) {
    const render::PictureSize size = parseSize(text, "--size " + text);
    if (size.width < 256 || size.height < 144 || size.width > 8192 || size.height > 8192)
        throw scenes::InputError("--size " + text, "must be from 256x144 to 8192x8192 pixels");
    return size;
}

studies::PictureSettings settingsFor(const PicturesOptions& options) {
    studies::PictureSettings settings;
    settings.videoPath = (fs::path(options.folder) / ".timing.mp4").string();
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
    if (!options.draw.size.empty()) settings.sizes = {sizeOf(options.draw.size)};
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

studies::SmoothingSettings smoothingSettingsFor(const PicturesOptions& options,
                                                const studies::PictureSettings& pictures) {
    studies::SmoothingSettings settings{pictures.particles, pictures.sizes.front(), pictures.frames};
    if (options.quick) settings.spacing = 0.5;
    return settings;
}

/// OpenGL as the study uses it.
struct OpenGl {
    std::unique_ptr<render::Context> context;  ///< null: the renderer on the CPU is measured alone
    std::string text;                          ///< its names of its renderer and version, or why it is not used
};

/// Opens OpenGL on the device of the options. If it cannot be used and no device was asked for, a warning says why.
/// @throws render::SystemError if the device that was asked for cannot be used
OpenGl openGlFor(const PicturesOptions& options) {
    const render::Device device = rendererOf(options.draw).device;
    try {
        auto context = std::make_unique<render::Context>(device);
        std::string text = fmt::format("OpenGL is {}, version {}", context->rendererName(), context->versionName());
        return {std::move(context), std::move(text)};
    } catch (const render::SystemError& error) {
        const std::string problem =
            fmt::format("OpenGL on {} cannot be used: {}", render::nameOf(device), error.what());
        if (!options.draw.device.empty()) throw render::SystemError(problem);
        printWarning(problem + "; the renderer on the CPU is measured alone");
        return {nullptr, problem};
    }
}

void reportRow(const PicturesOptions& options, const studies::PictureRow& row) {
    reportProgress(options,
                   {{"event", "row"},
                    {"style", studies::nameOf(row.style)},
                    {"particles", row.particles},
                    {"width", row.size.width},
                    {"quality", studies::nameOf(row.quality)},
                    {"renderer", studies::nameOf(row.renderer)},
                    {"seconds", row.moving.draw},
                    {"time_ratio", row.timeRatio},
                    {"rmse_ratio", row.rmseRatio},
                    {"ssim", row.error.ssim}},
                   fmt::format("{} {} {}x{} {}, {}: {:.4g} ms, {:.2f} of the CPU's time, SSIM {:.5f}\n",
                               studies::nameOf(row.style), row.particles, row.size.width, row.size.height,
                               studies::nameOf(row.quality), studies::nameOf(row.renderer), 1e3 * row.moving.draw,
                               row.timeRatio, row.error.ssim));
}

/// Measures everything. Each table is written again after each of its rows, because the study takes long and an
/// interrupted one should leave what it has measured.
PictureResults measure(const PicturesOptions& options, const studies::PictureSettings& settings,
                       render::Context* context) {
    const fs::path folder = options.folder;
    PictureResults results;
    results.rows = studies::measurePictures(settings, context, [&](const std::vector<studies::PictureRow>& rows) {
        writeFile(folder / "pictures.csv", studies::picturesCsv(rows));
        reportRow(options, rows.back());
    });
    results.looks = studies::measureLooks(settings, context, [&](const std::vector<studies::LookRow>& rows) {
        writeFile(folder / "looks.csv", studies::looksCsv(rows));
    });
    results.flicker = studies::measureFlicker(flickerSettingsFor(options), context,
                                              [&](const std::vector<studies::FlickerRow>& rows) {
                                                  writeFile(folder / "flicker.csv", studies::flickerCsv(rows));
                                              });
    results.smoothing = studies::measureSmoothing(smoothingSettingsFor(options, settings),
                                                  [&](const std::vector<studies::SmoothingRow>& rows) {
                                                      writeFile(folder / "skins.csv", studies::smoothingCsv(rows));
                                                  });
    return results;
}

/// The results as text for the terminal.
std::string summaryOf(const PictureResults& results) {
    Table table{{"style", "particles", "size", "quality", "renderer", "frame, ms", "rest, ms", "+PNG, ms", "+MP4, ms",
                 "time ratio", "RMSE", "RMSE ratio", "SSIM", "wrong, %"},
                {}};
    const auto milliseconds = [](double seconds) { return fmt::format("{:.2f}", 1e3 * seconds); };
    for (const studies::PictureRow& row : results.rows)
        table.rows.push_back({studies::nameOf(row.style), fmt::format("{}", row.particles),
                              fmt::format("{}x{}", row.size.width, row.size.height), studies::nameOf(row.quality),
                              studies::nameOf(row.renderer), milliseconds(row.moving.draw),
                              milliseconds(row.atRest.draw), row.encoding ? milliseconds(row.encoding->withPng) : "",
                              row.encoding ? milliseconds(row.encoding->withMp4) : "",
                              fmt::format("{:.2f}", row.timeRatio), fmt::format("{:.3f}", row.error.rmse),
                              fmt::format("{:.2f}", row.rmseRatio), fmt::format("{:.5f}", row.error.ssim),
                              fmt::format("{:.4f}", 100.0 * row.error.wrongHits)});
    std::string text = textTable(table) + results.openGl + "\n";
    for (const studies::LookRow& row : results.looks)
        text +=
            fmt::format("{}, {}, {} particles: {:.4g} ms, {:.2f} times the look as it is, RMSE {:.3f}, SSIM {:.5f}\n",
                        row.look, studies::nameOf(row.renderer), row.particles, 1e3 * row.draw, row.timeRatio,
                        row.error.rmse, row.error.ssim);
    for (const studies::FlickerRow& row : results.flicker)
        text += fmt::format("{} {}, {}, {} particles, {}x{}: camera moving, change {:.3f}, jerk {:.3f} steps of 255\n",
                            studies::nameOf(row.style), studies::nameOf(row.quality), studies::nameOf(row.renderer),
                            row.particles, row.size.width, row.size.height, row.change, row.jerk);
    for (const studies::SmoothingRow& row : results.smoothing)
        text += fmt::format("{} skin, {} particles: {:.4g} ms, volume {:.3f}, bumps {:.2f} degrees\n",
                            studies::nameOf(row.skin), row.particles, 1e3 * row.draw, row.volume, row.bumps);
    return text;
}

std::string commandOf(const PicturesOptions& options) {
    std::vector<std::string> words;
    if (!options.particles.empty()) words.emplace_back("--particles");
    for (const std::size_t count : options.particles) words.push_back(fmt::format("{}", count));
    if (!options.draw.size.empty()) words.insert(words.end(), {"--size", options.draw.size});
    if (!options.draw.device.empty()) words.insert(words.end(), {"--gl", options.draw.device});
    return commandLineOf(options, words);
}

void study(const PicturesOptions& options) {
    const int threads = threadCount(options.run);
    prepareMesa(threads);
    const OpenGl openGl = openGlFor(options);
    prepareFolder(options, {});
    const studies::PictureSettings settings = settingsFor(options);
    PictureResults results;
    onThreads(threads, [&] { results = measure(options, settings, openGl.context.get()); });
    results.openGl = openGl.text;
    fs::remove(settings.videoPath);
    results.timesPlot = writePlot(options, "times.svg", studies::pictureTimesPlot(results.rows, results.smoothing));
    results.errorsPlot = writePlot(options, "errors.svg", studies::pictureErrorsPlot(results.rows));
    finishStudy(options, picturesPage(results, commandOf(options)), summaryOf(results));
}

}  // namespace

void addStudyPictures(CLI::App& study) {
    CLI::App& command =
        *study.add_subcommand("pictures", "both renderers: time of a frame's stages, error against the exact picture");
    const auto options = std::make_shared<PicturesOptions>();
    options->draw.renderer = kRendererNames[1];
    command.add_option("--particles", options->particles, "how many (default: 2000 10000 50000 200000)")
        ->check(CLI::Range(100, 10000000))
        ->type_name("N");
    command.add_option("--size", options->draw.size, "of the picture (default: 1280x720 and 1920x1080)")
        ->type_name("WxH");
    addDeviceFlag(command, options->draw);
    addStudyFlags(command, *options, "fewer particles, small pictures");
    command.footer("Example: globular study pictures --quick -o out/pictures");
    command.callback([options] { tools::study(*options); });
}

}  // namespace tools
