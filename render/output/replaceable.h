// Which file a whole one may take the place of. Asked by all that write under another name and rename.
#pragma once

#include <filesystem>

namespace render {

/// The path, or what it leads to if it is a symbolic link.
/// Throws SystemError where that is a folder, which no file takes the place of, or a device or a pipe, which a rename
/// would destroy.
std::filesystem::path replaceable(const std::filesystem::path& path);

}  // namespace render
