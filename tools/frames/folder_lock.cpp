// The lock is on the folder itself, so that nothing is left behind.
#include "tools/frames/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "render/picture/system_error.h"
#include "tools/system/output_file.h"

namespace tools {

FolderLock::FolderLock(const std::filesystem::path& folder) {
    createFolder(folder);
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0)
        throw render::SystemError(fmt::format("cannot open folder {}: {}", folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(descriptor_);
    if (error == EWOULDBLOCK) throw render::SystemError(fmt::format("another run is writing into {}", folder.string()));
    throw render::SystemError(fmt::format("cannot lock folder {}: {}", folder.string(), std::strerror(error)));
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

}  // namespace tools
