// Reading and writing whole files. Every file except a video is written by this code: complete or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tools {

/// Creates a folder and its parents.
/// @throws render::SystemError with the system's reason
void createFolder(const std::filesystem::path& folder);

/// Creates the folder that a file is to be in, and its parents.
/// @throws render::SystemError with the system's reason
void createFolderOf(const std::filesystem::path& file);

/// Writes bytes to a temporary file in the same folder and renames it when they are on disk.
/// @throws render::SystemError on any failure; a file of that name is then unchanged
void writeFile(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void writeFile(const std::filesystem::path& path, const std::string& text);

/// The bytes of a file.
/// @throws render::SystemError
std::vector<std::uint8_t> readFile(const std::filesystem::path& path);

}  // namespace tools
