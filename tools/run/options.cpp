// Translates the texts of command-line flags into settings.
#include "tools/run/options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "render/output/atomic_file.h"
#include "render/output/video.h"
#include "render/overlay/text.h"
#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"
#include "scenes/text/value.h"
#include "scenes/warnings/start_warnings.h"
#include "tools/system/memory.h"
#include "tools/system/process.h"
#include "tools/system/processors.h"
#include "tools/system/text.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// The limits that the --limit flags set; each is a name and a whole number of at least 1.
scenes::Limits limitsOf(const std::vector<std::string>& flags) {
    scenes::Limits limits;
    for (const std::string& flag : flags) {
        const std::size_t equals = flag.find('=');
        const std::string name = flag.substr(0, equals);
        double* const limit = name == "particles" ? &limits.particles
                              : name == "frames"  ? &limits.frames
                              : name == "pixels"  ? &limits.pixels
                                                  : nullptr;
        if (limit == nullptr)
            throw scenes::InputError("--limit " + flag,
                                     "must be particles=N, frames=N or pixels=N, e.g. particles=5000000");
        const std::string_view text = std::string_view(flag).substr(std::min(equals, flag.size() - 1) + 1);
        const auto number = parseNumber<std::int64_t>(text);
        if (!number || *number < 1)
            throw scenes::InputError("--limit " + flag, fmt::format("{} must be a whole number > 0", name));
        *limit = static_cast<double>(*number);
    }
    return limits;
}

/// Warnings about characters of overlay.color_label that are not drawn as they are meant. It is the only text of a
/// scene that is drawn into pictures.
std::vector<std::string> labelWarnings(const std::string& label) {
    std::vector<std::string> warnings;
    // In quotes line breaks and other control characters are escaped.
    if (const std::string missing = render::charactersWithoutGlyph(label); !missing.empty())
        warnings.push_back(
            fmt::format("the font has no {}, which overlay.color_label asks for", scenes::tomlString(missing)));
    if (render::hasRightToLeftLetters(label))
        warnings.emplace_back(
            "overlay.color_label has letters that are written from right to left, but are drawn one by one "
            "from the left");
    return warnings;
}

}  // namespace

void printResult(const RunOptions& options, const Json& json, const std::string& text) {
    if (options.json)
        printJson(json);
    else if (!options.quiet)
        printText(text);
}

int threadCount(const RunOptions& options) {
    return options.threads > 0 ? options.threads : usableProcessors();
}

scenes::Scene load(const SceneOptions& options, const scenes::Overrides& more) {
    scenes::Overrides overrides(options.changes.begin(), options.changes.end());
    overrides.insert(overrides.end(), more.begin(), more.end());
    const scenes::Limits limits = limitsOf(options.limits);
    const auto read = [&] {
        if (options.scene == kStandardStream)
            return scenes::readScene(readStandardInput(scenes::kMaxSceneFileBytes), "<stdin>", overrides, limits);
        return scenes::loadScene(scenes::resolveScene(options.scene, sceneFolder()), overrides, limits);
    };
    scenes::Scene scene =
        withMemoryFor([&] { return "reading the scene " + options.scene; }, "give the scene fewer particles", read);
    if (const auto& colorBar = scene.look.common.overlay.colorBar)
        for (std::string& warning : labelWarnings(colorBar->title)) scene.warnings.push_back(std::move(warning));
    if (!options.isStrict)
        for (const std::string& warning : scene.warnings) printWarning(warning);
    return scene;
}

void refuse(const std::vector<std::string>& warnings) {
    if (!warnings.empty()) throw ExitStatus(kInputErrorCode, fmt::format("{}", fmt::join(warnings, "\n")));
}

void warnOfStart(const SceneOptions& options, const scenes::Scene& scene, int threads) {
    std::vector<std::string> warnings;
    onThreads(threads, [&] { warnings = scenes::startWarnings(scene); });
    if (options.isStrict) {
        warnings.insert(warnings.begin(), scene.warnings.begin(), scene.warnings.end());
        refuse(warnings);
    }
    for (const std::string& warning : warnings) printWarning(warning);
}

void warnOfSharpness(const SceneOptions& options, const DrawJob& job) {
    if (job.quality == render::Quality::final) return;
    const std::vector<std::string>& warnings = job.scene->blurWarnings;
    if (options.isStrict) refuse(warnings);
    for (const std::string& warning : warnings) printWarning(warning);
}

std::string runName(const SceneOptions& options) {
    if (options.scene == kStandardStream) return "stdin";
    const bool isFile = scenes::resolveScene(options.scene, sceneFolder()) == options.scene;
    return isFile ? fs::path(options.scene).stem().string() : options.scene;
}

std::string defaultOutput(const std::string& runName, std::string_view suffix) {
    return (fs::path("out") / (render::shortenedName(runName, suffix.size()) + std::string(suffix))).string();
}

scenes::Overrides overridesOf(const DrawOptions& options) {
    scenes::Overrides overrides;
    if (!options.style.empty()) overrides.emplace_back("look.style=" + options.style, "--style " + options.style);
    if (options.size.empty()) return overrides;
    const std::string flag = "--size " + options.size;
    const render::PictureSize size = parseSize(options.size, flag);
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", size.width, size.height), flag);
    return overrides;
}

std::string drawFlags(const DrawOptions& options) {
    const DrawOptions defaults;
    std::string flags;
    const auto add = [&](const char* flag, const std::string& value, const std::string& usual) {
        if (value != usual) flags += fmt::format(" {} {}", flag, value);
    };
    add("--size", options.size, defaults.size);
    add("--style", options.style, defaults.style);
    add("--quality", options.quality, defaults.quality);
    add("--renderer", options.renderer, defaults.renderer);
    add("--gl", options.device, defaults.device);
    return flags;
}

void requirePipedOutput(const RunOptions& options) {
    if (options.json) throw scenes::InputError("--json", "standard output is for the pictures, with -o -");
    if (::isatty(STDOUT_FILENO) == 1)
        throw scenes::InputError("-o -", "standard output is a terminal; send the pictures to a program or a file");
}

void requireVideoName(const std::string& flag, const std::string& path) {
    if (render::videoKindOf(path)) return;
    throw scenes::InputError(
        fmt::format("{} {}", flag, path),
        path == kStandardStream
            ? "a video cannot go to standard output; `globular render SCENE -o -` writes its frames there, for ffmpeg"
            : fmt::format("the name of a video says its kind: it must end in {}", render::kVideoExtensions));
}

RendererChoice rendererOf(const DrawOptions& options) {
    const auto name = std::find(kRendererNames.begin(), kRendererNames.end(), options.renderer);
    if (name == kRendererNames.end())
        throw scenes::InputError(
            "--renderer " + options.renderer,
            fmt::format("there is no such renderer; choose one of: {}", fmt::join(kRendererNames, ", ")));
    RendererChoice choice;
    choice.isOpenGl = name != kRendererNames.begin();
    if (options.device.empty()) return choice;
    const std::string flag = "--gl " + options.device;
    const auto device = render::deviceNamed(options.device);
    if (!device)
        throw scenes::InputError(flag,
                                 fmt::format("there is no such OpenGL device; choose one of: {} (see globular devices)",
                                             render::kDeviceNames));
    if (!choice.isOpenGl) throw scenes::InputError(flag, "the CPU draws; --gl is for --renderer opengl");
    choice.device = *device;
    return choice;
}

DrawJob drawJob(const scenes::Scene& scene, const DrawOptions& draw, const RunOptions& run, const std::string& title) {
    const render::Quality quality = draw.quality == "draft"   ? render::Quality::draft
                                    : draw.quality == "final" ? render::Quality::final
                                                              : render::Quality::normal;
    return {&scene, quality, rendererOf(draw), threadCount(run), run.verbosity(), title};
}

render::PictureSize parseSize(const std::string& text, const std::string& flag) {
    const std::size_t cross = text.find('x');
    const auto width = parseNumber(std::string_view(text).substr(0, cross));
    const auto height =
        cross == std::string::npos ? std::nullopt : parseNumber(std::string_view(text).substr(cross + 1));
    if (!width || !height) throw scenes::InputError(flag, "must be WIDTHxHEIGHT in pixels, e.g. 1280x720");
    return {*width, *height};
}

std::string sceneFolder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share" / "globular" / "scenes";
    if (!error && fs::is_directory(installed)) return installed.string();
    return GLOBULAR_SOURCE_SCENES;
}

}  // namespace tools
