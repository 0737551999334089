// The frames that all runs into a folder have drawn, chunks and others, checked file by file and put together. Used by
// `assemble`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/frames/frame_list.h"
#include "tools/frames/manifest.h"
#include "tools/system/json.h"

namespace tools {

struct JoinedFrames {
    /// What the manifest of a run of all frames would have: the frames whose files are there and as recorded, and those
    /// that were asked for.
    Manifest manifest;
    std::vector<int> whole;           ///< frames that were asked for, of which the files of all formats are as recorded
    std::vector<int> missing;         ///< frames that were asked for and lack a file, or one that is recorded
    std::vector<int> damaged;         ///< frames of which a file is none of those that are recorded
    std::vector<std::string> chunks;  ///< names of the chunks' manifests, in the order of the chunks
    Json machines = Json::array();    ///< the kinds of machines that have drawn chunks, without repetition
    Json reports = Json::array();     ///< those of the chunks that are complete

    /// Missing and damaged frames, in order.
    std::vector<int> toDraw() const;
};

/// Joins what the manifests in a folder list, and compares each frame's file with its checksum.
/// @param wanted  the frames that have to be there; nothing: those that the runs were asked for
/// @throws render::SystemError if there is no manifest of pictures, one cannot be read, or two are of different runs,
/// such as by different renderers
JoinedFrames joinFrames(const std::filesystem::path& folder, const std::optional<FrameList>& wanted = std::nullopt);

/// What may make the frames differ in their last bits although they are of one run; empty if nothing is known to. The
/// CPU renderer has the same bits on any machine. OpenGL on a CPU has not: Intel's and AMD's round some of its
/// instructions differently.
std::string machineWarning(const JoinedFrames& joined);

/// What run.json says of frames that chunks have drawn.
Json joinedReport(const JoinedFrames& joined);

}  // namespace tools
