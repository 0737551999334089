// Links are followed by hand: the last of them may lead to a file that is not there yet.
#include "render/output/replaceable.h"

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace fs = std::filesystem;

fs::path replaceable(const fs::path& path) {
    constexpr int kMostLinks = 40;  // as Linux
    std::error_code error;
    fs::path target = path;
    for (int link = 0; fs::is_symlink(fs::symlink_status(target, error)); ++link) {
        const fs::path next = fs::read_symlink(target, error);
        if (error || link == kMostLinks) throw SystemError(fmt::format("cannot follow the link {}", path.string()));
        target = target.parent_path() / next;
    }
    const fs::file_status status = fs::status(target, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw SystemError(fmt::format("cannot write {}: it is a {}, a file is wanted", path.string(),
                                      fs::is_directory(status) ? "folder" : "device or a pipe"));
    return target;
}

}  // namespace render
