// The folder that a run writes its frames into: a file for each frame and format, a manifest, and the last two
// checkpoints. That is all that is needed to resume the run, however it ended. The chunks of a run share a folder:
// their frames have the names that they have in a run of all frames, and each chunk has a manifest and checkpoints of
// its own. Used by `render`, `simulate` and `mesh`.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/run/advance.h"
#include "tools/frames/folder_lock.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/frame_names.h"
#include "tools/frames/manifest.h"
#include "tools/run/options.h"
#include "tools/system/json.h"

namespace tools {

/// A file that lists the frames of a format, for programs that want such a list.
struct FrameIndex {
    FrameNames names;  ///< of the frames that it lists, in another format than the default
    std::string fileName;
    std::function<std::string(const std::vector<int>& frames)> encode;
};

/// What a run writes to be resumed from a frame.
struct Checkpoint {
    std::vector<std::uint8_t> state;  ///< engine::encodeCheckpoint()
    std::string loads;                ///< the text of loads.csv up to the frame; empty if no loads are recorded
    Json report;                      ///< what the run has measured so far
};

/// A state to resume from, as read from a checkpoint.
struct RestartPoint {
    int frame = 0;
    engine::Simulation simulation;
    std::string loads;  ///< the text of loads.csv up to the frame
    Json report;        ///< what the run had measured when the checkpoint was written
};

/// The output folder of a run. It is locked while the object exists.
class FrameFolder {
 public:
    /// Locks the folder and examines its files; damaged ones are reported as warnings on standard error.
    /// @param names  of the files of each frame, one for each format
    /// @param frames  the frames that the run is asked for
    /// @param identity  an object with everything that determines the bytes of the frames
    /// @throws render::SystemError if another run is writing into the folder, or if the folder holds frames of another
    /// run that are not to be overwritten
    /// @throws scenes::InputError if a file of another origin has a name that the run may use, with `overwrite` or not
    FrameFolder(const FolderOptions& options, std::vector<FrameNames> names, const FrameList& frames,
                const Json& identity);
    /// Writes the manifest if frames are missing from it.
    ~FrameFolder();
    FrameFolder(const FrameFolder&) = delete;
    FrameFolder& operator=(const FrameFolder&) = delete;

    /// Whether the frame's file of this format was there and intact when the folder was opened, made by this chunk or
    /// by another, so that it need not be made again.
    bool isKept(int frame, const FrameNames& names) const;

    /// Whether all files of the frame are kept.
    bool isKept(int frame) const;

    /// The frame's file of the first format.
    std::filesystem::path pathOf(int frame) const;

    /// Wall-clock time between two checkpoints, s.
    double checkpointSeconds() const { return checkpointSeconds_; }

    /// The newest usable checkpoint of a frame up to `latest`; nothing if there is none or the run does not resume.
    std::optional<RestartPoint> restartPoint(const engine::Setup& setup, int latest) const;

    /// Writes the file of a frame in the first format.
    void write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash) {
        write(frame, names_.front(), bytes, stateHash);
    }

    /// Writes the file of a frame in one of the formats.
    void write(int frame, const FrameNames& names, std::span<const std::uint8_t> bytes, const std::string& stateHash);

    /// Writes an index of the frames that are there, and again whenever the manifest is written.
    void keepIndex(FrameIndex index);

    /// Writes a checkpoint of a frame, and loads.csv. The last two up to this frame are kept, and the newest of all.
    /// @pre the files of all frames up to this one are written
    void writeCheckpoint(int frame, const Checkpoint& checkpoint);

    /// Writes loads.csv, unless its text is empty or the run is a chunk, of which there may be several in the folder.
    void writeLoads(const std::string& text) const;

    /// Writes run.json, or for a chunk what would be in it into the chunk's manifest.
    void writeReport(const Json& json);

 private:
    bool readManifests(const std::vector<std::filesystem::path>& files, bool overwrites, const Json& identity);
    void requireOwnFiles(const std::vector<std::filesystem::path>& files, bool isDamaged) const;
    void removeFrames();
    void plan(const FolderOptions& options, const FrameList& frames);
    void keepIntactFrames(const FrameNames& names);
    void keepFramesOfOthers(const FrameList& frames, const FrameNames& names);
    FrameNames checkpointNames() const { return {checkpointPrefix_, kCheckpointExtension}; }
    void writeManifest();
    void writeIndex() const;

    std::filesystem::path folder_;
    std::optional<Chunk> chunk_;
    FolderLock lock_;
    std::string checkpointPrefix_;
    bool resumes_ = false;
    double checkpointSeconds_ = 0.0;
    std::vector<FrameNames> names_;
    Manifest manifest_;
    std::vector<Manifest> others_;  ///< manifests of other chunks, or of a run of all frames, in the same folder
    std::map<std::string_view, std::set<int>> kept_;  ///< by format
    std::optional<FrameIndex> index_;
    bool isManifestCurrent_ = true;  ///< whether the manifest on disk lists every frame
    std::chrono::steady_clock::time_point lastManifest_;
};

}  // namespace tools
