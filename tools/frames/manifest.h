// manifest.json: what a folder of frames holds. It identifies the run, so that frames of two runs are never mixed, and
// it has a checksum of every frame and checkpoint, so that a damaged file is noticed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tools/system/json.h"

namespace tools {

/// What the manifest records of the file of one frame.
struct FrameRecord {
    std::string checksum;   ///< checksum of the file
    std::string stateHash;  ///< hash of the particles that the frame shows
};

/// What the manifest records of the file of one checkpoint.
struct CheckpointRecord {
    std::string checksum;       ///< checksum of the file
    Json report;                ///< what the run had measured when the checkpoint was written
    std::size_t loadBytes = 0;  ///< how much of the file's end is the text of loads.csv up to its frame
};

/// What the manifest of a chunk records besides.
struct ChunkRecord {
    Json machines = Json::array();  ///< what has drawn the frames: an object for each kind of machine
    Json report;                    ///< what run.json says of a run; null until the chunk is complete
};

struct Manifest {
    Json identity;  ///< JSON object with everything that determines the bytes of the frames
    /// The frames whose files have been written in the default format: finished pictures, meshes, or PLY of states.
    std::map<int, FrameRecord> frames;
    /// Whether a run into this folder was asked for such files. If not, it may have files of theirs that are another's.
    bool hasFrames = true;
    /// The frames whose files have been written in other formats, by the name of the format. There is an entry for
    /// every format that a run into this folder was asked for.
    std::map<std::string, std::map<int, FrameRecord>, std::less<>> otherFormats;
    std::map<int, CheckpointRecord> checkpoints;  ///< checkpoints by the number of their frame
    /// The first and the last frame that a run into this folder was asked for. A run that was killed may have written
    /// some of them that `frames` does not have yet.
    std::optional<std::pair<int, int>> planned;
    /// The frames that runs into this folder were asked for, of all chunks together, as --frames takes them. Empty in
    /// manifests of earlier versions.
    std::string asked;
    std::optional<ChunkRecord> chunk;  ///< nothing for a run of all frames

    /// The frames that have been written in a format, which counts as asked for from now on.
    /// @param format  its name; empty for the default format
    std::map<int, FrameRecord>& framesIn(std::string_view format);

    /// The same; nullptr if no run into this folder was asked for the format.
    const std::map<int, FrameRecord>* findFrames(std::string_view format) const;

    /// Whether the file of this frame and format belongs to the runs of the manifest.
    bool lists(int frame, std::string_view format) const;
};

/// FNV-1a hash of the bytes as 16 hexadecimal digits.
std::string checksumOf(std::span<const std::uint8_t> bytes);

std::string encodeManifest(const Manifest& manifest);

/// Whether a file of any content is a manifest of this program's, whole or damaged. Other programs have files of the
/// same name.
bool isManifest(std::span<const std::uint8_t> text);

/// @param name  names the file in the error
/// @throws render::SystemError if the text is not a manifest
Manifest decodeManifest(std::span<const std::uint8_t> text, const std::string& name);

/// How two identities differ, such as "scene_hash: 12ab there, 34cd here"; empty if they are equal.
std::string differences(const Json& there, const Json& here);

}  // namespace tools
