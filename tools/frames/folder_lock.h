// Keeps two runs from writing the same frames into one folder at the same time.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/frames/chunk.h"

namespace tools {

/// A folder, created if needed, that no other run can write into while the object exists, or only other chunks of the
/// same run. The locks are the operating system's, so that they end with the process, however that ends. On a file
/// system without locks there is a warning instead.
class FolderLock {
 public:
    /// @param chunk  the chunk beside which others may write into the folder; nothing for a run of all frames. On a
    /// network file system the same chunk on another machine is noticed, too, because a chunk locks a file; folders are
    /// locked on one machine alone
    /// @throws render::SystemError if a run that may not write at the same time holds a lock
    explicit FolderLock(const std::filesystem::path& folder, const std::optional<Chunk>& chunk = std::nullopt);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    void lockFolder(const std::filesystem::path& folder, int kind);
    void lockFile(const std::filesystem::path& folder, const Chunk& chunk);

    int folder_ = -1;
    int file_ = -1;
    std::filesystem::path path_;  ///< of the locked file; empty for a run of all frames
};

/// Whether a file is one that a chunk locks while it runs. A killed one leaves it behind, unlocked.
bool isChunkLock(const std::filesystem::path& file);

}  // namespace tools
