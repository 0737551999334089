// Reads in blocks, so that a device or a pipe cannot fill the memory before the limit is noticed.
#include "scenes/text/read_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16U;

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw InputError({{path, 0, 0, "cannot be read: " + why}});
}

}  // namespace

std::string readFile(const std::string& path, std::size_t limit) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) fail(path, "it is a folder");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, errno == 0 ? "it cannot be opened" : std::generic_category().message(errno));
    std::string bytes;
    std::vector<char> block(kBlock);
    while (file) {
        file.read(block.data(), static_cast<std::streamsize>(block.size()));
        bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
        if (bytes.size() > limit) fail(path, fmt::format("it is larger than {} MiB", limit >> 20U));
    }
    if (file.bad()) fail(path, "reading stopped before its end");
    return bytes;
}

}  // namespace scenes
