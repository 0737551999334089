// Which picture is held against which: two files, two folders, or the frames of videos. Used by `compare` and
// `approve`.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tools {

/// A folder of its own below the system's temporary one, removed with the object.
class TemporaryFolder {
 public:
    /// Throws render::SystemError.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

/// The pictures of one side. Of a folder: every PNG below it, by its path from there ("liquid/frame-00012.png"). Of a
/// video: its frames as `render` names them. Of a PNG: itself.
struct PictureSet {
    std::map<std::string, std::filesystem::path> pictures;
    bool single = false;                       ///< one file, whatever its name
    std::shared_ptr<TemporaryFolder> decoded;  ///< keeps the frames of a video while the set is in use
};

/// Nothing there: an empty set. Throws render::SystemError for what cannot be read, or a video that ffmpeg cannot
/// decode.
PictureSet picturesOf(const std::filesystem::path& path);

struct PicturePair {
    std::string name;
    std::optional<std::filesystem::path> actual;
    std::optional<std::filesystem::path> expected;
};

/// By name, in order; single files with each other under the expected one's name.
/// Throws render::SystemError when a file meets a folder.
std::vector<PicturePair> pairsOf(const PictureSet& actual, const PictureSet& expected);

}  // namespace tools
