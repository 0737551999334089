// The folder that a run writes its frames into: one file for each frame, a manifest, and the last two checkpoints. That
// is all that is needed to resume the run, however it ended. Used by `render` and `simulate`.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/run/advance.h"
#include "tools/run/frame_list.h"
#include "tools/run/manifest.h"
#include "tools/run/options.h"
#include "tools/system/json.h"

namespace tools {

/// How the numbered files of a run are named: a prefix, the frame number with at least five digits, an extension.
struct FrameNames {
    std::string_view prefix;
    std::string_view extension;

    /// The name of a frame's file, such as "frame-00042.png".
    std::string fileName(int frame) const;
    /// The frame whose file has this name, in any folder; nothing if the file is not one of the series.
    std::optional<int> frameOf(const std::filesystem::path& file) const;
};
inline constexpr FrameNames kPictureNames = {"frame-", ".png"};
inline constexpr FrameNames kStateNames = {"particles-", ".ply"};

/// Whether a run may write a file of this name into its folder: a frame, a checkpoint, manifest.json or run.json.
bool isRunFile(const std::filesystem::path& file);

/// The files in a folder, in no order.
/// @throws render::SystemError
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

/// A folder, created if needed, that no other run can write into while the object exists. The lock is the operating
/// system's, so that it ends with the process, however that ends.
class FolderLock {
 public:
    /// @throws render::SystemError if another run holds the lock
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    int descriptor_ = -1;
};

/// A state to resume from, as read from a checkpoint.
struct RestartPoint {
    int frame = 0;
    engine::Simulation simulation;
    Json report;  ///< what the run had measured when the checkpoint was written
};

/// The output folder of a run. It is locked while the object exists.
class FrameFolder {
 public:
    /// Locks the folder and examines its files; damaged ones are reported as warnings on standard error.
    /// @param frames  the frames that the run is asked for
    /// @param identity  an object with everything that determines the bytes of the frames
    /// @throws render::SystemError if another run is writing into the folder, or if the folder holds frames of another
    /// run that are not to be overwritten
    /// @throws scenes::InputError if a file of another origin has a name that the run may use, with `overwrite` or not
    FrameFolder(const FolderOptions& options, FrameNames names, const FrameList& frames, const Json& identity);
    /// Writes the manifest if frames are missing from it.
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;

    /// Whether the frame's file was there and intact when the folder was opened, so that it need not be made again.
    bool isKept(int frame) const { return kept_.count(frame) == 1; }

    std::filesystem::path pathOf(int frame) const;

    /// Wall-clock time between two checkpoints, s.
    double checkpointSeconds() const { return checkpointSeconds_; }

    /// The newest usable checkpoint of a frame up to `latest`; nothing if there is none or the run does not resume.
    std::optional<RestartPoint> restartPoint(const engine::Setup& setup, int latest) const;

    /// Writes the file of a frame.
    void write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash);

    /// Writes a checkpoint of a frame. The last two up to this frame are kept, and the newest of all.
    /// @param bytes  engine::encodeCheckpoint()
    /// @param report  what the run has measured so far
    /// @pre the files of all frames up to this one are written
    void writeCheckpoint(int frame, std::span<const std::uint8_t> bytes, const Json& report);

    /// Writes run.json.
    void writeReport(const Json& json) const;

 private:
    void requireOwnFiles(bool isDamaged) const;
    void removeFrames();
    void keepIntactFrames();
    void writeManifest();

    std::filesystem::path folder_;
    FolderLock lock_;
    bool resumes_ = false;
    double checkpointSeconds_ = 0.0;
    FrameNames names_;
    Manifest manifest_;
    std::map<int, FrameRecord> kept_;
    bool isManifestCurrent_ = true;  ///< whether the manifest on disk lists every frame
    std::chrono::steady_clock::time_point lastManifest_;
};

}  // namespace tools
