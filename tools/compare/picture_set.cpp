// Lists the pictures below a folder, and compares the names of pictures.
#include "tools/compare/picture_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <system_error>
#include <vector>

#include "render/picture/system_error.h"
#include "tools/system/command_files.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToRead(const fs::path& folder, const std::error_code& error) {
    throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
}

/// Whether a file that is no folder counts as a picture.
bool isPicture(const fs::directory_entry& file) {
    // Only PNG can be read. The others are results, and not left out.
    constexpr std::array kFormats = {".png", ".jpg",  ".jpeg", ".gif", ".bmp",  ".webp",
                                     ".tif", ".tiff", ".ppm",  ".exr", ".avif", ".heic"};
    std::error_code ignored;
    const bool leadsNowhere = file.is_symlink(ignored) && !file.exists(ignored);
    return leadsNowhere || std::any_of(kFormats.begin(), kFormats.end(),
                                       [&](const char* format) { return hasExtension(file.path(), format); });
}

/// Whether a folder has the pictures of a report, which may have been written among the pictures that it is about.
bool isOfReport(const fs::path& folder) {
    return folder.filename() == kReportPictures && isOwnPage(folder.parent_path() / "index.html");
}

/// The pictures below a folder by their path in it. Links to folders are followed, but no folder is entered again from
/// below itself.
auto picturesBelow(const fs::path& folder) {
    decltype(PictureSet::pictures) pictures;
    std::error_code error;
    constexpr auto kFollow = fs::directory_options::follow_directory_symlink;
    std::vector<fs::path> entered{fs::canonical(folder, error)};  // real paths of the folders around the present entry
    fs::path last = folder;
    for (fs::recursive_directory_iterator file(folder, kFollow, error), end; !error && file != end;
         file.increment(error)) {
        last = file->path();
        entered.resize(static_cast<std::size_t>(file.depth()) + 1);
        if (std::error_code ignored; file->is_directory(ignored)) {
            entered.push_back(fs::canonical(last, error));
            if (error) break;
            const bool isAround = std::find(entered.begin(), entered.end() - 1, entered.back()) != entered.end() - 1;
            if (isAround || isOfReport(last)) file.disable_recursion_pending();
        } else if (isPicture(*file)) {
            pictures.emplace(last.lexically_relative(folder).generic_string(), last);
        }
    }
    if (error) failToRead(last, error);
    return pictures;
}

/// Whether a character is written as a part of the one before it: combining marks, the voiced sound marks of Japanese,
/// and the vowels and final consonants of Korean syllables.
bool isCombining(char32_t c) {
    return (c >= 0x300 && c <= 0x36F) || c == 0x3099 || c == 0x309A || (c >= 0x1160 && c <= 0x11FF);
}

/// The number of characters that a letter and the combining marks after it take.
std::size_t lengthWithMarks(const std::u32string& text, std::size_t index) {
    std::size_t length = 1;
    while (index + length < text.size() && isCombining(text[index + length])) ++length;
    return length;
}

/// Whether a character may be a letter and its marks in one.
bool isComposed(const std::u32string& text, std::size_t index) {
    return text[index] >= 0x80 && !isCombining(text[index]) && lengthWithMarks(text, index) == 1;
}

}  // namespace

bool hasExtension(const fs::path& path, std::string_view extension) {
    const std::string own = path.extension().string();
    return std::equal(own.begin(), own.end(), extension.begin(), extension.end(),
                      [](unsigned char a, char b) { return std::tolower(a) == b; });
}

bool isVideoName(const fs::path& path) {
    constexpr std::array kVideos = {".mp4", ".mkv", ".webm", ".gif"};
    return std::any_of(kVideos.begin(), kVideos.end(), [&](const char* video) { return hasExtension(path, video); });
}

bool ByNumber::operator()(const std::string& a, const std::string& b) const {
    return ::strverscmp(a.c_str(), b.c_str()) < 0;
}

PictureSet picturesOf(const fs::path& path) {
    PictureSet set;
    set.path = path;
    if (!fs::exists(path)) {
        set.isSingle = hasExtension(path, ".png");
    } else if (fs::is_directory(path)) {
        set.pictures = picturesBelow(path);
    } else if (isVideoName(path)) {
        set.isVideo = true;
    } else {
        set.isSingle = true;
        set.pictures.emplace(path.filename().string(), path);
    }
    return set;
}

bool differInUnicodeForm(const std::string& a, const std::string& b) {
    std::u32string one, other;
    try {
        one = fs::path(a).u32string();
        other = fs::path(b).u32string();
    } catch (const std::system_error&) {
        return false;  // a name that is not UTF-8
    }
    std::size_t i = 0, j = 0;
    while (i < one.size() && j < other.size()) {
        std::size_t lengthOne = 1, lengthOther = 1;
        if (one[i] != other[j]) {
            lengthOne = lengthWithMarks(one, i);
            lengthOther = lengthWithMarks(other, j);
            const bool isPair = (lengthOne > 1 && isComposed(other, j)) || (lengthOther > 1 && isComposed(one, i));
            if (!isPair) return false;
        }
        i += lengthOne;
        j += lengthOther;
    }
    return a != b && i == one.size() && j == other.size();
}

}  // namespace tools
