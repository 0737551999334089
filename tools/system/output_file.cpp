// Temporary name, write, flush to disk, rename; every call's result is checked.
#include "tools/system/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <system_error>

#include "render/output/replaceable.h"
#include "render/picture/system_error.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const char* attempt, const fs::path& path, int error) {
    throw render::SystemError(fmt::format("cannot {} {}: {}", attempt, path.string(), std::strerror(error)));
}

/// An open file descriptor; removes its file unless it was kept.
class TemporaryFile {
 public:
    explicit TemporaryFile(fs::path path) : path_(std::move(path)) {
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
        if (descriptor_ < 0) fail("write", path_, errno);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
        if (!kept_) ::unlink(path_.c_str());
    }

    void write(std::span<const std::uint8_t> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) fail("write", path_, errno);
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
    }

    void keepAs(const fs::path& target) {
        if (::fsync(descriptor_) != 0) fail("flush", path_, errno);
        const int closed = ::close(descriptor_);
        descriptor_ = -1;
        if (closed != 0) fail("close", path_, errno);
        if (::rename(path_.c_str(), target.c_str()) != 0) fail("rename to", target, errno);
        kept_ = true;
    }

 private:
    fs::path path_;
    int descriptor_ = -1;
    bool kept_ = false;
};

}  // namespace

void createFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail("create folder", folder, error.value());
    if (!fs::is_directory(folder)) fail("create folder", folder, ENOTDIR);
}

void writeFile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    const fs::path target = render::replaceable(path);
    TemporaryFile file(target.parent_path() / fmt::format(".{}.partial", target.filename().string()));
    file.write(bytes);
    file.keepAs(target);
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
