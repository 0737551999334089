// Which pictures a path stands for: one file, all pictures below a folder, or the frames of a video. Used by `compare`
// and `approve`.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace tools {

/// Whether the file name has this extension, in upper or lower case.
/// @param extension  in lower case, such as ".png"
bool hasExtension(const std::filesystem::path& path, std::string_view extension);

/// Whether a path names a video that `render` writes and ffmpeg decodes, by its extension.
bool isVideoName(const std::filesystem::path& path);

/// Orders names by the numbers in them: frame-99999.png before frame-100000.png.
struct ByNumber {
    bool operator()(const std::string& a, const std::string& b) const;
};

/// The actual or the expected pictures of a comparison.
struct PictureSet {
    std::filesystem::path path;
    /// Files by name. The names in a folder are paths below it ("liquid/frame-00012.png"). Empty for a video.
    std::map<std::string, std::filesystem::path, ByNumber> pictures;
    bool isSingle = false;  ///< the set is one file, whose name does not matter
    bool isVideo = false;   ///< the set is the frames of a video, under the names that `render` gives to frames
};

/// The folder beside index.html for the pictures of a report of `compare`.
inline constexpr const char* kReportPictures = "index-files";

/// The pictures that a path stands for; none if nothing exists at the path. Everything below a folder that may be a
/// picture counts, so that nothing is left out of a check without a word: pictures of formats that cannot be read, and
/// links that lead nowhere, which may have led to a folder of pictures. Only pictures of reports do not count.
/// @throws render::SystemError if a folder cannot be read
PictureSet picturesOf(const std::filesystem::path& path);

/// Whether two different names look the same because one has composed characters where the other has letters followed
/// by combining marks: Unicode's normalization forms NFC, which most systems write, and NFD, which macOS writes. Which
/// letter a composed character stands for is not looked up.
bool differInUnicodeForm(const std::string& a, const std::string& b);

}  // namespace tools
