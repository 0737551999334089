// Which picture is compared with which: two files, two folders, or the frames of videos. Used by `compare` and
// `approve`.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// Whether the file name has this extension, in upper or lower case.
/// @param extension  in lower case, such as ".png"
bool hasExtension(const std::filesystem::path& path, std::string_view extension);

/// The actual or the expected pictures of a comparison, by name. The names in a folder are the paths of all PNG files
/// below it ("liquid/frame-00012.png"); those in a video are what `render` calls its frames.
struct PictureSet {
    std::map<std::string, std::filesystem::path> pictures;
    bool isSingle = false;                      ///< the set is one file, whose name does not matter
    std::shared_ptr<const void> decodedFrames;  ///< keeps the temporary folder with the frames of a video; else null
};

/// The pictures that a path stands for: one file, all PNG files below a folder, or the frames of a video. There are
/// none if nothing exists at the path.
/// @throws render::SystemError if a folder cannot be read or ffmpeg cannot decode a video
PictureSet picturesOf(const std::filesystem::path& path);

struct PicturePair {
    std::string name;
    std::optional<std::filesystem::path> actual;
    std::optional<std::filesystem::path> expected;
};

/// Pairs of pictures with the same name, ordered by name. Two single files form a pair under the expected file's name.
/// @throws render::SystemError if one side is a file and the other a folder or video
std::vector<PicturePair> pairsOf(const PictureSet& actual, const PictureSet& expected);

}  // namespace tools
