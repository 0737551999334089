// Folders are walked, videos decoded by ffmpeg into a temporary one.
#include "tools/compare/picture_pairs.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

std::map<std::string, fs::path> pngsBelow(const fs::path& folder) {
    std::map<std::string, fs::path> pictures;
    std::error_code error;
    for (fs::recursive_directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
        const fs::path& path = file->path();
        // Files still being written begin with a dot.
        if (path.extension() != ".png" || path.filename().string().starts_with(".")) continue;
        pictures.emplace(path.lexically_relative(folder).generic_string(), path);
    }
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return pictures;
}

PictureSet framesOf(const fs::path& video) {
    PictureSet set;
    set.decoded = std::make_shared<TemporaryFolder>();
    // A path that looks like a protocol is still a file, and a percent sign in the folder's name no part of the
    // pattern.
    std::string pattern = "file:";
    for (const char c : set.decoded->path().string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
    pattern += "/frame-%05d.png";
    render::ChildProcess ffmpeg(
        {"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-i", "file:" + video.string(),
         "-fps_mode", "passthrough", "-sws_flags", "accurate_rnd+full_chroma_int+bitexact", "-pix_fmt", "rgb24",
         "-start_number", "0", pattern},
        render::kNoTimeout);
    if (const std::string ending = ffmpeg.wait(); !ending.empty())
        throw render::SystemError(
            fmt::format("ffmpeg cannot decode {}: {}: {}", video.string(), ending, ffmpeg.output()));
    set.pictures = pngsBelow(set.decoded->path());
    return set;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "globular-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr)
        throw render::SystemError(fmt::format("cannot create folder {}: {}", pattern, std::strerror(errno)));
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

PictureSet picturesOf(const fs::path& path) {
    PictureSet set;
    if (!fs::exists(path)) {
        set.single = path.extension() == ".png";
        return set;
    }
    if (fs::is_directory(path)) {
        set.pictures = pngsBelow(path);
        return set;
    }
    if (path.extension() == ".mp4") return framesOf(path);
    set.single = true;
    set.pictures.emplace(path.filename().string(), path);
    return set;
}

std::vector<PicturePair> pairsOf(const PictureSet& actual, const PictureSet& expected) {
    if (!actual.pictures.empty() && !expected.pictures.empty() && actual.single != expected.single)
        throw render::SystemError(
            "one side is a single picture, the other a folder or a video; compare like with like");
    if (actual.single && actual.pictures.size() == 1 && expected.pictures.size() == 1)
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
