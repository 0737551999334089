// Lists the PNG files below a folder; ffmpeg decodes the frames of a video into a temporary folder.
#include "tools/compare/picture_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// The PNG files below a folder by their path in it. Links to folders are followed, but no folder is entered again from
/// below itself.
std::map<std::string, fs::path> pngsBelow(const fs::path& folder) {
    std::map<std::string, fs::path> pictures;
    std::error_code error;
    constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
    std::vector<fs::path> entered{fs::canonical(folder, error)};  // real paths of the folders around the present entry
    for (fs::recursive_directory_iterator file(folder, kFollow, error), end; !error && file != end;
         file.increment(error)) {
        const fs::path& path = file->path();
        entered.resize(static_cast<std::size_t>(file.depth()) + 1);
        if (std::error_code ignored; file->is_directory(ignored)) {
            entered.push_back(fs::canonical(path));
            if (std::find(entered.begin(), entered.end() - 1, entered.back()) != entered.end() - 1)
                file.disable_recursion_pending();
        }
        // Names of files that are still being written begin with a dot.
        if (!hasExtension(path, ".png") || path.filename().string().starts_with(".")) continue;
        pictures.emplace(path.lexically_relative(folder).generic_string(), path);
    }
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return pictures;
}

/// A new folder below the system's temporary folder; removed with its content when the object is destroyed.
struct TemporaryFolder {
    std::string path = (fs::temp_directory_path() / "globular-XXXXXX").string();

    TemporaryFolder() {
        if (::mkdtemp(path.data()) == nullptr)
            throw render::SystemError(fmt::format("cannot create folder {}: {}", path, std::strerror(errno)));
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

PictureSet decodeVideo(const fs::path& video) {
    PictureSet set;
    const auto folder = std::make_shared<TemporaryFolder>();
    set.decodedFrames = folder;
    // "file:" keeps ffmpeg from taking a path with a colon for a protocol. Percent signs are doubled, because ffmpeg
    // reads the path as a pattern.
    std::string pattern = "file:";
    for (const char c : folder->path) pattern += c == '%' ? std::string("%%") : std::string(1, c);
    pattern += "/frame-%05d.png";
    render::ChildProcess ffmpeg(
        {"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-i", "file:" + video.string(),
         "-fps_mode", "passthrough", "-sws_flags", "accurate_rnd+full_chroma_int+bitexact", "-pix_fmt", "rgb24",
         "-start_number", "0", pattern},
        render::kNoTimeout);
    if (const std::string ending = ffmpeg.wait(); !ending.empty())
        throw render::SystemError(
            fmt::format("ffmpeg cannot decode {}: {}: {}", video.string(), ending, ffmpeg.output()));
    set.pictures = pngsBelow(folder->path);
    return set;
}

}  // namespace

bool hasExtension(const fs::path& path, std::string_view extension) {
    const std::string own = path.extension().string();
    return std::equal(own.begin(), own.end(), extension.begin(), extension.end(),
                      [](unsigned char a, char b) { return std::tolower(a) == b; });
}

PictureSet picturesOf(const fs::path& path) {
    PictureSet set;
    if (!fs::exists(path)) {
        set.isSingle = hasExtension(path, ".png");
        return set;
    }
    if (fs::is_directory(path)) {
        set.pictures = pngsBelow(path);
        return set;
    }
    if (hasExtension(path, ".mp4")) return decodeVideo(path);
    set.isSingle = true;
    set.pictures.emplace(path.filename().string(), path);
    return set;
}

std::vector<PicturePair> pairsOf(const PictureSet& actual, const PictureSet& expected) {
    if (!actual.pictures.empty() && !expected.pictures.empty() && actual.isSingle != expected.isSingle)
        throw render::SystemError(
            "one side is a single picture, the other a folder or a video; compare like with like");
    if (actual.isSingle && actual.pictures.size() == 1 && expected.pictures.size() == 1)
        return {{expected.pictures.begin()->first, actual.pictures.begin()->second, expected.pictures.begin()->second}};
    std::map<std::string, PicturePair> pairs;
    for (const auto& [name, path] : actual.pictures) pairs[name].actual = path;
    for (const auto& [name, path] : expected.pictures) pairs[name].expected = path;
    std::vector<PicturePair> list;
    for (auto& [name, pair] : pairs) {
        pair.name = name;
        list.push_back(std::move(pair));
    }
    return list;
}

}  // namespace tools
