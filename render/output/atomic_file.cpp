// A temporary file is locked (flock) while it is written. The lock ends with the process, however that ends, so that a
// temporary file without a lock has been abandoned. The files that ffmpeg writes are locked by the process that started
// ffmpeg.
#include "render/output/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".partial";
constexpr std::size_t kRandomLength = 6;
constexpr std::size_t kLongestName = 255;  // longest name of a file on the common file systems of Linux, bytes

[[noreturn]] void fail(const char* attempt, const fs::path& path, int error) {
    throw SystemError(fmt::format("cannot {} {}: {}", attempt, path.string(), std::generic_category().message(error)));
}

/// The file that `path` leads to. Symbolic links are followed one by one, because the last may lead to a file that does
/// not exist yet.
fs::path resolved(const fs::path& path) {
    constexpr int kMostLinks = 40;  // the limit of Linux
    std::error_code error;
    fs::path target = path;
    for (int link = 0; fs::is_symlink(fs::symlink_status(target, error)); ++link) {
        const fs::path next = fs::read_symlink(target, error);
        if (error || link == kMostLinks) throw SystemError(fmt::format("cannot follow the link {}", path.string()));
        target = target.parent_path() / next;
    }
    // To rename a file to this path cannot replace a folder, and would destroy a device or a pipe.
    const fs::file_status status = fs::status(target, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw SystemError(fmt::format("cannot write {}: it is a {}, a file is wanted", path.string(),
                                      fs::is_directory(status) ? "folder" : "device or a pipe"));
    return target;
}

/// The part of a temporary file's name that is the name of its target, cut off where the whole would be too long.
std::string stemOf(const std::string& name) {
    return shortenedName(name, 2 + kRandomLength + kSuffix.size());  // and two dots
}

std::string randomLetters() {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device random;
    std::uniform_int_distribution<std::size_t> index(0, kLetters.size() - 1);
    std::string letters;
    for (std::size_t k = 0; k < kRandomLength; ++k) letters += kLetters[index(random)];
    return letters;
}

/// Whether another process has removed the file with removeAbandonedFiles() before this process could lock it.
bool isRemoved(int descriptor) {
    struct stat status = {};
    return ::fstat(descriptor, &status) == 0 && status.st_nlink == 0;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : target_(resolved(path)) {
    struct stat old = {};
    if (::stat(target_.c_str(), &old) == 0) mode_ = old.st_mode & 0777;
    // mkostemp() would create the file with mode 0600, which must then become 0666 without the umask; but the umask
    // cannot be read without changing it for all threads. Until it is whole, the file can be read by no more users than
    // the one that it replaces.
    const mode_t mode = mode_ ? (*mode_ | 0600) : 0666;
    while (descriptor_ < 0) {
        const std::string name = fmt::format(".{}.{}{}", stemOf(target_.filename().string()), randomLetters(), kSuffix);
        temporaryPath_ = target_.parent_path() / name;
        descriptor_ = ::open(temporaryPath_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
        if (descriptor_ < 0 && errno != EEXIST) fail("write", target_, errno);
        if (descriptor_ < 0) continue;
        ::flock(descriptor_, LOCK_EX);  // fails on a file system without locks, where the file then stays unlocked
        if (isRemoved(descriptor_)) ::close(std::exchange(descriptor_, -1));
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0) return;
    ::unlink(temporaryPath_.c_str());
    ::close(descriptor_);
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail("write", target_, errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit() {
    // A file system without permissions refuses to set those of the old file, and then there are none to keep.
    if (mode_) static_cast<void>(::fchmod(descriptor_, *mode_));
    if (::fsync(descriptor_) != 0) fail("flush", target_, errno);
    if (std::rename(temporaryPath_.c_str(), target_.c_str()) != 0) fail("rename a temporary file to", target_, errno);
    // After fsync() no error is left for close() to report.
    ::close(std::exchange(descriptor_, -1));
}

void AtomicFile::removeAbandoned() const {
    const std::string stem = stemOf(target_.filename().string());
    removeAbandonedFiles(target_.parent_path(), [&](const std::string& name) { return name == stem; });
}

std::string shortenedName(const std::string& name, std::size_t more) {
    std::size_t length = std::min(name.size(), kLongestName - more);
    const auto continuesCharacter = [&] { return (static_cast<unsigned char>(name[length]) & 0xC0) == 0x80; };
    while (length < name.size() && length > 0 && continuesCharacter()) --length;
    return name.substr(0, length);
}

void removeAbandonedFiles(const fs::path& folder, const std::function<bool(const std::string&)>& isOurs) {
    constexpr std::size_t kAround = 2 + kRandomLength + kSuffix.size();
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.size() <= kAround || name.front() != '.' || !name.ends_with(kSuffix)) continue;
        if (!isOurs(name.substr(1, name.size() - kAround))) continue;
        const int file = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
        if (file < 0) continue;
        // The encoder of a killed run may still be writing: its file is unlinked, and the disk space is freed when the
        // encoder ends.
        if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
        ::close(file);
    }
}

}  // namespace render
