// Folders and whole files, with the system's own words in every error.
#include "tools/system/output_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"

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

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    render::AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

void writeFile(const fs::path& path, const std::string& text) {
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::vector<std::uint8_t> readFile(const fs::path& path) {
    if (fs::is_directory(path)) fail("read", path, EISDIR);
    std::ifstream stream(path, std::ios::binary | std::ios::ate);
    if (!stream) fail("read", path, errno);
    const auto size = static_cast<std::streamoff>(stream.tellg());
    if (size < 0) fail("read", path, errno);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    stream.seekg(0);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) fail("read", path, errno);
    return bytes;
}

}  // namespace tools
