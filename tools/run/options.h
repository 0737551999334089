// The options that several commands share, as plain data, and what they mean. The commands fill them in from flags
// (tools/commands/command_line.cpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/opengl/context/device.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"
#include "tools/frames/chunk.h"
#include "tools/system/json.h"
#include "tools/system/progress.h"

namespace tools {

/// Options on what the program prints and how many threads it uses.
struct RunOptions {
    bool quiet = false;
    bool json = false;
    int threads = 0;  ///< number of threads; 0: one for each processor that the process may use

    Verbosity verbosity() const { return json ? Verbosity::json : quiet ? Verbosity::quiet : Verbosity::normal; }
};

/// What a command line calls standard input, as a SCENE, and standard output, as the name of an output.
inline constexpr const char* kStandardStream = "-";

/// A scene and changes to it.
struct SceneOptions {
    std::string scene;                 ///< path of a scene file, name of a built-in scene, or kStandardStream
    std::vector<std::string> changes;  ///< changes of keys, "key=value"
    std::vector<std::string> limits;   ///< raised limits on particles, frames or pixels, "name=number"
    bool isStrict = false;             ///< whether warnings about the scene are errors
};

/// How frames are drawn.
struct DrawOptions {
    std::string size;   ///< picture size, "WIDTHxHEIGHT" in pixels; empty: the scene's
    std::string style;  ///< style, "spheres" or "metaballs"; empty: the scene's
    std::string quality = "normal";
    std::string renderer = "cpu";  ///< one of kRendererNames
    std::string device;            ///< name of the OpenGL renderer's device; empty: osmesa
};

/// The names of the renderers: on the CPU's vector units, and in OpenGL's shaders.
inline constexpr std::array kRendererNames = {"cpu", "opengl"};

/// Which renderer draws.
struct RendererChoice {
    bool isOpenGl = false;
    render::Device device;  ///< where OpenGL draws; unused by the other renderer
};

/// The folder that the frames of a run go to, and what happens to frames that are already in it. Without `resume` and
/// `overwrite`, frames of the same run are written again, and frames of another run are an error.
struct FolderOptions {
    std::string path;
    bool resume = false;              ///< whether intact frames of the same run stay
    bool overwrite = false;           ///< whether all files of an earlier run are removed from the folder first
    double checkpointSeconds = 5.0;   ///< wall-clock time between two checkpoints, s
    std::optional<Chunk> chunk = {};  ///< the part of the run that is to be made; nothing: all of it
    std::string allFrames = {};       ///< the frames of all chunks, as --frames takes them; only for a chunk
};

/// How the frames of a scene are drawn, by render_loop.h or stills.h.
struct DrawJob {
    const scenes::Scene* scene = nullptr;
    render::Quality quality = render::Quality::normal;
    RendererChoice renderer;
    int threads = 1;
    Verbosity verbosity = Verbosity::normal;
    std::string title;  ///< name of the work in messages about its progress
};

/// Prints a result of a command: JSON on a line of its own with --json, else the text unless --quiet.
void printResult(const RunOptions& options, const Json& json, const std::string& text);

/// The number of threads to use, at least 1.
int threadCount(const RunOptions& options);

/// Loads the scene with its changes, and prints its warnings unless the options are strict.
/// @param more  further changes, which other flags ask for; applied last
/// @throws scenes::InputError
scenes::Scene load(const SceneOptions& options, const scenes::Overrides& more = {});

/// Throws warnings as errors, a line for each, if there are any.
/// @throws ExitStatus with kInputErrorCode
void refuse(const std::vector<std::string>& warnings);

/// Prints the warnings about the start of a scene (scenes/warnings/start_warnings.h). If the options are strict, throws
/// them as errors, with those of the scene file.
/// @param threads  number of threads to look for them with
/// @throws ExitStatus as refuse()
void warnOfStart(const SceneOptions& options, const scenes::Scene& scene, int threads);

/// Prints a warning for each key of the scene that blurs pictures, where the job's quality has no blur. If the options
/// are strict, throws them as errors.
/// @throws ExitStatus as refuse()
void warnOfSharpness(const SceneOptions& options, const DrawJob& job);

/// What a run of the scene is called in the names of its files: a built-in scene as it was given, such as "hard/honey",
/// a scene file by its name without folder and extension, and standard input "stdin".
/// @throws scenes::InputError if there is no such scene
std::string runName(const SceneOptions& options);

/// Where a run of this name writes what has a suffix, such as "-mesh", if it is not told where: below out/, with the
/// name shortened to what a file name may be long.
std::string defaultOutput(const std::string& runName, std::string_view suffix);

/// The size and the style that flags ask for, as changes to the scene.
/// @throws scenes::InputError
scenes::Overrides overridesOf(const DrawOptions& options);

/// The flags that give these options, each after a space; none for what is the default.
std::string drawFlags(const DrawOptions& options);

/// Makes sure that pictures can be written to standard output: nothing else is printed there, and no person reads it.
/// @throws scenes::InputError
void requirePipedOutput(const RunOptions& options);

/// Makes sure that a file name has the extension of a kind of video, so that what the name says is what is written.
/// @throws scenes::InputError naming the flag and the extensions that are possible
void requireVideoName(const std::string& flag, const std::string& path);

/// The renderer of the options.
/// @throws scenes::InputError if there is no renderer or device of that name, or a device without the OpenGL renderer
RendererChoice rendererOf(const DrawOptions& options);

/// How to draw a scene with these options.
/// @throws scenes::InputError as rendererOf()
DrawJob drawJob(const scenes::Scene& scene, const DrawOptions& draw, const RunOptions& run, const std::string& title);

/// Width and height of a text such as "1280x720".
/// @param flag  names the flag in the error
/// @throws scenes::InputError if the text is not two whole numbers
render::PictureSize parseSize(const std::string& text, const std::string& flag);

/// The folder of the built-in scenes: beside the installed program, or else in the sources that it was built from.
std::string sceneFolder();

}  // namespace tools
