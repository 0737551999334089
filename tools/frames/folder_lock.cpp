// A run of all frames locks its folder alone; chunks lock it together, and each a file of its own in it.
#include "tools/frames/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "render/picture/system_error.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kLockSuffix = ".lock";

/// Locks an open file or folder, which it closes if that fails.
/// @param kind  LOCK_EX or LOCK_SH
/// @param refusal  the message if another process has locked it
void lock(int& descriptor, int kind, const fs::path& path, const std::string& refusal) {
    if (::flock(descriptor, kind | LOCK_NB) == 0) return;
    const int error = errno;
    if (error == ENOSYS || error == EOPNOTSUPP || error == ENOLCK)
        return printWarning(fmt::format(
            "{} is on a file system without locks: make sure that no other run writes there", path.string()));
    ::close(std::exchange(descriptor, -1));
    if (error == EWOULDBLOCK) throw render::SystemError(refusal);
    throw render::SystemError(fmt::format("cannot lock {}: {}", path.string(), std::strerror(error)));
}

/// Whether an open file is still the one at a path. The process that held its lock before may have removed it.
bool isAt(int descriptor, const fs::path& path) {
    struct stat open = {};
    struct stat there = {};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &there) == 0 && open.st_ino == there.st_ino &&
           open.st_dev == there.st_dev;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::optional<Chunk>& chunk) {
    lockFolder(folder, chunk ? LOCK_SH : LOCK_EX);
    try {
        if (chunk) lockFile(folder, *chunk);
    } catch (...) {
        ::close(folder_);
        throw;
    }
}

FolderLock::~FolderLock() {
    if (file_ >= 0) ::unlink(path_.c_str());
    if (file_ >= 0) ::close(file_);
    ::close(folder_);
}

void FolderLock::lockFolder(const fs::path& folder, int kind) {
    createFolder(folder);
    folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0)
        throw render::SystemError(fmt::format("cannot open folder {}: {}", folder.string(), std::strerror(errno)));
    lock(folder_, kind, folder, fmt::format("another run is writing into {}", folder.string()));
}

void FolderLock::lockFile(const fs::path& folder, const Chunk& chunk) {
    path_ = folder / fmt::format(".{}{}", nameOf(chunk), kLockSuffix);
    while (file_ < 0) {
        file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file_ < 0)
            throw render::SystemError(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
        lock(file_, LOCK_EX, path_, fmt::format("another run is writing {} into {}", nameOf(chunk), folder.string()));
        if (!isAt(file_, path_)) ::close(std::exchange(file_, -1));
    }
}

bool isChunkLock(const fs::path& file) {
    const std::string name = file.filename().string();
    std::string_view rest = name;
    if (!rest.starts_with('.')) return false;
    rest.remove_prefix(1);
    return takeChunkName(rest) && rest == kLockSuffix;
}

}  // namespace tools
