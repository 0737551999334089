// The names of the files that a run writes into its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/picture_formats.h"
#include "scenes/particles/formats.h"
#include "tools/frames/chunk.h"

namespace tools {

/// How the numbered files of a run are named: a prefix, the frame number with at least five digits, an extension.
struct FrameNames {
    std::string_view prefix;
    std::string_view extension;
    std::string_view format =
        "";  ///< what the manifest calls them; empty for pictures, meshes and the default of states

    /// The name of a frame's file, such as "frame-00042.png".
    std::string fileName(int frame) const;
    /// The frame whose file has this name, in any folder; nothing if the file is not one of the series.
    std::optional<int> frameOf(const std::filesystem::path& file) const;
};
inline constexpr FrameNames kPictureNames = {"frame-", ".png"};
inline constexpr FrameNames kStateNames = {"particles-", ".ply"};

/// How pictures in a format are named: those of the default format as kPictureNames.
FrameNames pictureNames(const render::PictureFormat& format);

/// How particle states in a format are named.
FrameNames stateNames(const scenes::ParticleFormat& format);

/// How files with the metaballs' field are named, which `globular simulate --format vdb` writes.
inline constexpr FrameNames kFieldNames = {"particles-", ".vdb", "vdb"};

/// How meshes are named.
/// @param format  "ply", "obj" or "vdb"; "ply" is taken for any other text
FrameNames meshNames(std::string_view format);

/// How all files are named that show a frame: pictures, states, fields and meshes in every format.
std::vector<FrameNames> allFrameNames();

/// The file that lists the .vtp files of a folder, for ParaView.
inline constexpr const char* kVtpSeriesName = "particles.vtp.series";

/// The table of the loads of a run's obstacles; load_table.h has its columns.
inline constexpr const char* kLoadsName = "loads.csv";

/// Extension of checkpoints, which are numbered by frame.
inline constexpr std::string_view kCheckpointExtension = ".state";

/// Prefix of the names of a run's checkpoints: "checkpoint-", or for a chunk "chunk-2-of-4-checkpoint-".
std::string checkpointPrefix(const std::optional<Chunk>& chunk);

/// Whether a file has the name of a checkpoint, of a run of all frames or of any chunk.
bool isCheckpointName(const std::filesystem::path& file);

/// The name of a run's manifest: "manifest.json", or for a chunk "chunk-2-of-4.json".
std::string manifestName(const std::optional<Chunk>& chunk);

/// Whether a file has the name of a manifest, of a run of all frames or of any chunk.
bool isManifestName(const std::filesystem::path& file);

/// Whether a run may write a file of this name into its folder: a frame, a checkpoint, a manifest,
/// run.json, loads.csv or the series of .vtp files.
bool isRunFile(const std::filesystem::path& file);

/// The files in a folder, in no order.
/// @throws render::SystemError
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

}  // namespace tools
