// A folder that a run writes its frames into, one file each, with a manifest and the last two checkpoints beside them:
// all that is needed to go on after any end. Used by `render` and `simulate`.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/advance.h"
#include "tools/run/manifest.h"
#include "tools/system/json.h"

namespace tools {

/// What to do with frames that are there already.
enum class Existing {
    replace,   ///< those of the same run are written again, those of another stop this one
    keep,      ///< those of the same run stay: --resume
    overwrite  ///< all of them are removed
};

/// How the files of a folder's frames are called: frame-00042.png, or particles-00042.ply.
struct FrameNames {
    std::string_view prefix;
    std::string_view extension;
};
inline constexpr FrameNames kPictureNames = {"frame-", ".png"};
inline constexpr FrameNames kStateNames = {"particles-", ".ply"};

/// A folder that no other run may write into meanwhile. The lock is the system's: it goes with the process, however
/// that ends.
class FolderLock {
 public:
    /// Throws: render::SystemError where another run holds it.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    int descriptor_ = -1;
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
    Json report;
};

class FrameFolder {
 public:
    /// Creates the folder and takes hold of it until the object goes. Looks at what is there: with Existing::keep the
    /// frames that are whole stay.
    /// Shape:  identity as in Manifest.
    /// Throws: render::SystemError where another run is at work in it, or its frames are of another run.
    FrameFolder(const FolderOptions& options, FrameNames names, const Json& identity);
    /// Lists what was written.
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;

    /// Whether a frame was there, whole, when the folder was opened, and stays.
    bool isKept(int frame) const { return kept_.count(frame) == 1; }

    std::filesystem::path pathOf(int frame) const;

    /// The newest state at or before a frame that can be gone on from; nothing for a run that starts at the start, as
    /// all do but those that keep what is there.
    std::optional<Restart> restart(const engine::Setup& setup, int latest) const;

    /// Puts a frame's file in its place.
    void write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash);

    /// Puts a checkpoint (encodeCheckpoint) of a frame in its place, when all frames up to it are in theirs. The last
    /// two up to it stay, and the newest of all.
    void writeCheckpoint(int frame, std::span<const std::uint8_t> bytes, const Json& report);

 private:
    void removeHalfWritten() const;
    bool hasFrames() const;
    void removeAll();
    void keepWhole();
    void writeManifest();
    std::filesystem::path checkpointPath(int frame) const;
    void removeUnlistedCheckpoints() const;

    std::filesystem::path folder_;
    FolderLock lock_;
    bool resumes_ = false;
    FrameNames names_;
    std::function<void(const std::string&)> warn_;
    Manifest manifest_;
    std::map<int, FrameRecord> kept_;
    bool isListed_ = true;  ///< the manifest's file has all frames
    std::chrono::steady_clock::time_point lastListing_;
};

}  // namespace tools
