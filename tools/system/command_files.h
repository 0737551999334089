// Keeps what a command writes apart from what it reads, before anything is done. Every command that writes files lists
// them here.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tools {

/// A file that a command will write, and the flag or argument that names it, such as "--video".
struct OutputFile {
    std::string flag;
    std::filesystem::path path;
};

/// A folder that a command will write into.
struct OutputFolder {
    std::string flag;
    std::filesystem::path path;
    std::function<bool(const std::filesystem::path&)> isWritten;  ///< whether the command writes a file of this name
};

/// Everything that one call of a command reads and writes.
struct CommandFiles {
    std::vector<std::filesystem::path> inputs;  ///< those that do not exist do not count
    std::vector<OutputFile> outputs;
    std::vector<OutputFolder> folders;
};

/// Whether a file is a page that globular has written: whether its title begins with the program's name, as those of
/// all its pages do. A later run replaces no other page.
bool isOwnPage(const std::filesystem::path& file);

/// Makes sure that no output replaces an input or another output of the same command or the page of another program,
/// and that none is "-", which is a name for standard output. Files are the same if they have the same inode, whatever
/// names or links lead to them.
/// @throws scenes::InputError naming every output that would
void requireSeparate(const CommandFiles& files);

}  // namespace tools
