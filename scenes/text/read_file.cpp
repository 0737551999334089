// Reads a file in blocks, so that a device or a pipe without an end cannot fill the memory before the limit is noticed.
#include "scenes/text/read_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "scenes/text/input_error.h"

namespace scenes {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 16U;

[[noreturn]] void failToRead(const std::string& path, const std::string& reason) {
    throw InputError(path, "cannot be read: " + reason);
}

}  // namespace

std::vector<std::uint8_t> readFile(const std::string& path, std::size_t limit) {
    std::error_code noSize;
    if (std::filesystem::is_directory(path, noSize)) failToRead(path, "it is a folder");
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) failToRead(path, errno == 0 ? "it cannot be opened" : std::generic_category().message(errno));
    std::vector<std::uint8_t> bytes;
    // Reserving the memory at once avoids copies of a large file as it grows. A device or a pipe has no size.
    const std::uintmax_t size = std::filesystem::file_size(path, noSize);
    if (!noSize) bytes.reserve(std::min<std::uintmax_t>(size, limit));
    std::vector<char> block(kBlockBytes);
    while (file) {
        file.read(block.data(), static_cast<std::streamsize>(block.size()));
        bytes.insert(bytes.end(), block.data(), block.data() + file.gcount());
        if (bytes.size() > limit) failToRead(path, fmt::format("it is larger than {} MiB", limit >> 20U));
    }
    if (file.bad()) failToRead(path, "reading stopped before its end");
    return bytes;
}

}  // namespace scenes
