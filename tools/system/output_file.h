// The only way the program writes files: whole or not at all. Libraries hand over bytes; this puts them on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// Creates a folder and its parents. Throws render::SystemError with the system's own words.
void createFolder(const std::filesystem::path& folder);

/// Writes bytes under another name in the same folder and renames when they are on disk.
/// Throws render::SystemError; what stood under the name before is then untouched.
void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void writeFile(const std::filesystem::path& path, const std::string& text);

/// The bytes of a file. Throws render::SystemError.
std::vector<std::uint8_t> readFile(const std::filesystem::path& path);

}  // namespace tools
