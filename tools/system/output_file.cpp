// Folders and whole files, with the system's own words in every error.
#include "tools/system/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* attempt, const fs::path& path, int error) {
    throw render::SystemError(fmt::format("cannot {} {}: {}", attempt, path.string(), std::strerror(error)));
}

}  // namespace

void createFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail("create folder", folder, error.value());
    if (!fs::is_directory(folder)) fail("create folder", folder, ENOTDIR);
}

void createFolderOf(const fs::path& file) {
    if (file.has_parent_path()) createFolder(file.parent_path());
}

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    render::AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void writeFile(const fs::path& path, const std::string& text) {
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<std::uint8_t> readFile(const fs::path& path) {
    try {
        return scenes::readFile(path.string());
    } catch (const scenes::InputError& error) {
        // The program has written the files that it reads here, so that one that cannot be read is no mistake of the
        // user.
        throw render::SystemError(error.what());
    }
}

}  // namespace tools
