// Files that appear under their name only when they are whole. Every file of the program is written through this: PNG,
// JSON and HTML by tools/system/output_file.cpp, videos by video.cpp, whose encoder writes to the temporary path
// itself.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace render {

/// A temporary file in the folder of its target, named `.TARGET.RANDOM.partial`. Every object has a file of its own, so
/// that two runs may write the same target: both succeed, and the file is that of the last one to finish, never a mix.
/// The file is created anew under a random name: a link or file that lies in the folder already is never opened.
class AtomicFile {
 public:
    /// Creates the temporary file, empty. Where `path` is a symbolic link, its target is the file that is replaced.
    /// Throws SystemError when the file cannot be created, or when `path` is a folder, a device or a pipe.
    explicit AtomicFile(const std::filesystem::path& path);
    /// Removes the temporary file unless commit() has succeeded.
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Path of the temporary file, for another program that writes it instead of write(). That program must write into
    /// the file, not replace it.
    const std::filesystem::path& temporaryPath() const { return temporaryPath_; }

    /// Removes the temporary files that killed runs have left for the same target.
    void removeAbandoned() const;

    /// Appends bytes to the temporary file. Throws SystemError.
    void write(std::span<const std::uint8_t> bytes);

    /// Flushes the file to the disk and renames it to its target. A file that was there before keeps its permissions;
    /// a new one gets those of any new file (0666 without the umask). Throws SystemError.
    void commit();

 private:
    std::filesystem::path target_;
    std::filesystem::path temporaryPath_;
    std::optional<mode_t> mode_;  ///< permissions of the file that is replaced; nothing if there is none
    int descriptor_ = -1;
};

/// The beginning of a file name, such that `more` bytes after it do not make it longer than file systems allow (255
/// bytes). No UTF-8 character is cut.
std::string shortenedName(const std::string& name, std::size_t more);

/// Removes the temporary files that killed runs have left in a folder. Files that a running program is still writing
/// are locked and stay. On a file system without locks, all stay.
/// @param isOurs  whether temporary files for a target of this name (without folder) are to be removed
void removeAbandonedFiles(const std::filesystem::path& folder, const std::function<bool(const std::string&)>& isOurs);

}  // namespace render
