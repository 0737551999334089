// The names of the files that a run writes into its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
inline constexpr FrameNames kCheckpointNames = {"checkpoint-", ".state"};

/// Whether a run may write a file of this name into its folder: a frame, a checkpoint, manifest.json or run.json.
bool isRunFile(const std::filesystem::path& file);

/// The files in a folder, in no order.
/// @throws render::SystemError
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder);

}  // namespace tools
