// A folder that a run writes its frames into, one file each, with a manifest and the last two checkpoints beside them:
// all that is needed to go on after any end. Used by `render` and `simulate`.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/simulation.h"
#include "tools/manifest.h"

namespace tools {

/// What to do with frames that are there already.
enum class Existing {
    replace,   ///< those of the same run are written again, those of another stop this one
    keep,      ///< those of the same run stay: --resume
    overwrite  ///< all of them are removed
};

/// How the files of a folder's frames are called: "frame-" and ".png" make frame-00042.png.
struct FrameNames {
    std::string prefix;
    std::string extension;
};

/// A folder as the command line says it.
struct FolderOptions {
    std::string path;
    Existing existing = Existing::replace;
    double checkpointSeconds = 5.0;                                            ///< between two checkpoints
    std::function<void(const std::string&)> warn = [](const std::string&) {};  ///< told of what is damaged, a line each
};

/// A state to go on from, as it was read.
struct Restart {
    int frame = 0;
    engine::Simulation simulation;
    nlohmann::ordered_json report;
};

class FrameFolder {
 public:
    /// Creates the folder and takes hold of it until the object goes. Looks at what is there: with Existing::keep the
    /// frames that are whole stay.
    /// Shape:  identity as in Manifest.
    /// Throws: render::SystemError where another run is at work in it, or its frames are of another run.
    FrameFolder(const FolderOptions& options, FrameNames names, const nlohmann::ordered_json& identity);
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;

    /// Whether a frame was there, whole, when the folder was opened, and stays.
    bool isKept(int frame) const { return kept_.count(frame) == 1; }

    std::filesystem::path pathOf(int frame) const;

    /// The newest state at or before a frame that can be gone on from; nothing for a run that starts at the start.
    std::optional<Restart> restart(const engine::Setup& setup, int latest) const;

    /// Puts a frame's file in its place.
    void write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash);

    /// Puts a checkpoint (encodeCheckpoint) of a frame in its place, when all frames up to it are in theirs. The last
    /// two stay.
    void writeCheckpoint(int frame, std::span<const std::uint8_t> bytes, const nlohmann::ordered_json& report);

 private:
    void hold();
    void removeHalfWritten() const;
    bool isFrame(const std::filesystem::path& file) const;
    bool hasFrames() const;
    void removeAll();
    void keepWhole();
    void writeManifest() const;
    std::filesystem::path checkpointPath(int frame) const;
    void removeUnlistedCheckpoints() const;

    std::filesystem::path folder_;
    FrameNames names_;
    std::function<void(const std::string&)> warn_;
    Manifest manifest_;
    std::map<int, FrameRecord> kept_;
    int hold_ = -1;  ///< descriptor of the folder, locked
};

}  // namespace tools
