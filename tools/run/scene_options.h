// The flags that several commands share, and what they mean together. One place, so that they read alike everywhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/opengl/context.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"
#include "tools/run/command_line.h"
#include "tools/run/frame_folder.h"
#include "tools/system/progress.h"

namespace tools {

/// How the program talks and how many threads it uses.
struct RunOptions {
    bool quiet = false;
    bool json = false;
    int threads = 0;  ///< 0: as many as the machine has

    Verbosity verbosity() const { return json ? Verbosity::json : quiet ? Verbosity::quiet : Verbosity::normal; }
};

/// Which scene, with what changed.
struct SceneOptions {
    std::string scene;                 ///< path or built-in name
    std::vector<std::string> changes;  ///< key=value
    std::vector<std::string> limits;   ///< name=number
};

/// How frames are drawn.
struct DrawOptions {
    std::string size;   ///< WxH; empty: the scene's
    std::string style;  ///< empty: the scene's
    std::string quality = "normal";
    std::string backend = "osmesa";
};

/// The folder that frames go to.
struct FolderFlags {
    std::string path;  ///< empty: out/NAME
    bool resume = false;
    bool overwrite = false;
    double checkpointSeconds = 5.0;
};

void addTo(const Command& command, RunOptions& options);
void addTo(const Command& command, SceneOptions& options);
void addTo(const Command& command, DrawOptions& options);
void addTo(const Command& command, FolderFlags& options);

/// The number of threads to use, at least 1.
int threadCount(const RunOptions& options);

/// The folder of a run called `name`; what is damaged in it is said on stderr.
FolderOptions folderOf(const FolderFlags& flags, const std::string& name);

/// The scene with its changes, and with those that other flags ask for. Throws scenes::InputError.
scenes::Scene load(const SceneOptions& options, const scenes::Overrides& others = {});

/// The size and the style that flags ask for, as changes to the scene. Throws scenes::InputError.
scenes::Overrides overridesOf(const DrawOptions& options);

render::Quality qualityOf(const DrawOptions& options);

/// Throws render::SystemError for a name that is no backend.
render::Backend backendOf(const DrawOptions& options);

/// Folders of the built-in scenes: beside the installed program, else in the sources it was built from.
std::vector<std::string> sceneFolders();

/// Inclusive frame numbers.
struct FrameRange {
    int first = 0;
    int last = 0;
};

/// "A-B" or "A" within 0 to count - 1; empty text means all. Throws scenes::InputError.
FrameRange frameRange(const std::string& text, int count);

}  // namespace tools
