// The flags that several commands share, so that they read alike everywhere.
#include "tools/commands/commands.h"

namespace tools {

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
    addBackendFlag(command, options);
}

void addBackendFlag(const Command& command, DrawOptions& options) {
    command.option("--gl", options.backend, "OpenGL backend: osmesa or egl (default: osmesa)").of("NAME");
}

void addTo(const Command& command, FolderOptions& options, const std::string& fallback) {
    command.option("-o,--output", options.path, "folder for frames and run.json (default: " + fallback + ")").of("DIR");
    const Flag resume =
        command.flag("--resume", options.resume, "go on with a run that ended early: what is whole stays");
    command.flag("--overwrite", options.overwrite, "remove the frames of another run from the folder first")
        .notWith(resume);
    command.option("--checkpoint", options.checkpointSeconds, "seconds between two checkpoints (default: 5)")
        .of("SECONDS")
        .atLeastZero();
}

}  // namespace tools
