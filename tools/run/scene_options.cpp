// Flags to settings.
#include "tools/run/scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "scenes/build/library.h"
#include "scenes/text/input_error.h"
#include "tools/system/parse_number.h"
#include "tools/system/standard_streams.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failFlag(const std::string& flag, const std::string& message) {
    throw scenes::InputError({{flag, 0, 0, message}});
}

/// The limits of the flags: names and whole numbers, at least 1.
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
            failFlag("--limit " + flag, "must be particles=N, frames=N or pixels=N, e.g. particles=5000000");
        const std::string_view text = std::string_view(flag).substr(std::min(equals, flag.size() - 1) + 1);
        const auto number = parseNumber<std::int64_t>(text);
        if (!number || *number < 1) failFlag("--limit " + flag, fmt::format("{} must be a whole number > 0", name));
        *limit = static_cast<double>(*number);
    }
    return limits;
}

}  // namespace

void addTo(const Command& command, RunOptions& options) {
    command.flag("--quiet", options.quiet, "no progress and no summary");
    command.flag("--json", options.json, "progress and result as JSON, one object a line, on stdout");
    command.option("--threads", options.threads, "how many threads to use (default: all of the machine)")
        .within(1, 1024);
}

void addTo(const Command& command, SceneOptions& options) {
    command.option("SCENE", options.scene, "a scene file, or the name of a built-in scene (see globular scenes)")
        .required();
    command.option("--set", options.changes, "change a key of the scene, e.g. --set physics.step=0.005")
        .of("KEY=VALUE")
        .oneAtATime();
    command.option("--limit", options.limits, "allow a larger scene: particles=N, frames=N or pixels=N (of a picture)")
        .of("NAME=N")
        .oneAtATime();
}

void addTo(const Command& command, DrawOptions& options) {
    command.option("--size", options.size, "picture size in pixels (default: the scene's)").of("WxH");
    command.option("--style", options.style, "spheres or metaballs (default: the scene's)")
        .oneOf({"spheres", "metaballs"});
    command.option("--quality", options.quality, "draft, normal or final (default: normal)")
        .oneOf({"draft", "normal", "final"});
    command.option("--gl", options.backend, "OpenGL backend: osmesa or egl (default: osmesa)").of("NAME");
}

void addTo(const Command& command, FolderFlags& options) {
    command.option("-o,--output", options.path, "folder for frames and run.json (default: out/NAME)").of("DIR");
    const Flag resume =
        command.flag("--resume", options.resume, "go on with a run that ended early: what is whole stays");
    command.flag("--overwrite", options.overwrite, "remove the frames of another run from the folder first")
        .notWith(resume);
    command.option("--checkpoint", options.checkpointSeconds, "seconds between two checkpoints (default: 5)")
        .of("SECONDS")
        .atLeastZero();
}

FolderOptions folderOf(const FolderFlags& flags, const std::string& name) {
    FolderOptions options;
    options.path = flags.path.empty() ? (fs::path("out") / name).string() : flags.path;
    if (flags.resume) options.existing = Existing::keep;
    if (flags.overwrite) options.existing = Existing::overwrite;
    options.checkpointSeconds = flags.checkpointSeconds;
    options.warn = [](const std::string& line) { printToStderr(fmt::format("warning: {}\n", line)); };
    return options;
}

int threadCount(const RunOptions& options) {
    if (options.threads > 0) return options.threads;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

scenes::Scene load(const SceneOptions& options, const scenes::Overrides& others) {
    scenes::Overrides overrides(options.changes.begin(), options.changes.end());
    overrides.insert(overrides.end(), others.begin(), others.end());
    return scenes::loadScene(scenes::resolveScene(options.scene, sceneFolders()), overrides, limitsOf(options.limits));
}

scenes::Overrides overridesOf(const DrawOptions& options) {
    scenes::Overrides overrides;
    if (!options.style.empty()) overrides.emplace_back("look.style=" + options.style, "--style " + options.style);
    if (options.size.empty()) return overrides;
    const std::string flag = "--size " + options.size;
    const std::size_t cross = options.size.find('x');
    const auto width = parseNumber(std::string_view(options.size).substr(0, cross));
    const auto height =
        cross == std::string::npos ? std::nullopt : parseNumber(std::string_view(options.size).substr(cross + 1));
    if (!width || !height) failFlag(flag, "must be WIDTHxHEIGHT in pixels, e.g. 1280x720");
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", *width, *height), flag);
    return overrides;
}

render::Quality qualityOf(const DrawOptions& options) {
    if (options.quality == "draft") return render::Quality::draft;
    return options.quality == "final" ? render::Quality::final : render::Quality::normal;
}

render::Backend backendOf(const DrawOptions& options) {
    const auto backend = render::backendNamed(options.backend);
    if (!backend)
        throw UsageError(fmt::format("there is no OpenGL backend \"{}\"; choose one of: {}", options.backend,
                                     render::kBackendNames));
    return *backend;
}

std::vector<std::string> sceneFolders() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share" / "globular" / "scenes";
    if (!error && fs::is_directory(installed)) return {installed.string()};
    return {GLOBULAR_SOURCE_SCENES};
}

FrameRange frameRange(const std::string& text, int count) {
    if (text.empty()) return {0, count - 1};
    const std::size_t dash = text.find('-');
    const auto first = parseNumber(std::string_view(text).substr(0, dash));
    const auto last = dash == std::string::npos ? first : parseNumber(std::string_view(text).substr(dash + 1));
    const std::string flag = "--frames " + text;
    if (!first || !last) failFlag(flag, "must be FIRST-LAST or a single frame, e.g. 0-119");
    if (*first > *last) failFlag(flag, fmt::format("the first frame, {}, comes after the last, {}", *first, *last));
    if (*last >= count) failFlag(flag, fmt::format("the scene has frames 0 to {}", count - 1));
    return {*first, *last};
}

}  // namespace tools
