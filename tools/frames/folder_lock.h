// Keeps two runs from writing into one folder at the same time.
#pragma once

#include <filesystem>

namespace tools {

/// A folder, created if needed, that no other run can write into while the object exists. The lock is the operating
/// system's, so that it ends with the process, however that ends.
class FolderLock {
 public:
    /// @throws render::SystemError if another run holds the lock
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    int descriptor_ = -1;
};

}  // namespace tools
