// The flags that several commands share, so that they read alike everywhere.
#include "tools/commands/commands.h"

namespace tools {

void addTo(CLI::App& command, RunOptions& options) {
    command.add_flag("--quiet", options.quiet, "no progress and no summary");
    command.add_flag("--json", options.json, "progress and result as JSON, one object a line, on stdout");
    command.add_option("--threads", options.threads, "how many threads to use (default: all of the machine)")
        ->check(CLI::Range(1, 1024));
}

void addTo(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, "a scene file, or the name of a built-in scene (see globular scenes)")
        ->required();
    command.add_option("--set", options.changes, "change a key of the scene, e.g. --set physics.step=0.005")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--limit", options.limits, "allow a larger scene: particles=N, frames=N or pixels=N (of a picture)")
        ->type_name("NAME=N")
        ->allow_extra_args(false);
}

void addTo(CLI::App& command, DrawOptions& options) {
    command.add_option("--size", options.size, "picture size in pixels (default: the scene's)")->type_name("WxH");
    command.add_option("--style", options.style, "spheres or metaballs (default: the scene's)")
        ->check(CLI::IsMember({"spheres", "metaballs"}));
    command.add_option("--quality", options.quality, "draft, normal or final (default: normal)")
        ->check(CLI::IsMember({"draft", "normal", "final"}));
    addBackendFlag(command, options);
}

void addBackendFlag(CLI::App& command, DrawOptions& options) {
    command.add_option("--gl", options.backend, "OpenGL backend: osmesa or egl (default: osmesa)")->type_name("NAME");
}

void addTo(CLI::App& command, FolderOptions& options, const std::string& fallback) {
    command.add_option("-o,--output", options.path, "folder for frames and run.json (default: " + fallback + ")")
        ->type_name("DIR");
    CLI::Option* resume =
        command.add_flag("--resume", options.resume, "go on with a run that ended early: what is whole stays");
    command.add_flag("--overwrite", options.overwrite, "remove the frames of another run from the folder first")
        ->excludes(resume);
    command.add_option("--checkpoint", options.checkpointSeconds, "seconds between two checkpoints (default: 5)")
        ->type_name("SECONDS")
        ->check(numberAtLeastZero());
}

}  // namespace tools
