// Numbers in file names have at least five digits, so that the names of most runs sort like the frames.
#include "tools/frames/frame_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/picture/system_error.h"
#include "tools/system/text.h"

namespace tools {

namespace fs = std::filesystem;

std::string FrameNames::fileName(int frame) const {
    return fmt::format("{}{:05}{}", prefix, frame, extension);
}

std::optional<int> FrameNames::frameOf(const fs::path& file) const {
    const std::string name = file.filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(extension)) return std::nullopt;
    const std::string_view digits = std::string_view(name).substr(prefix.size());
    const auto frame = parseNumber(digits.substr(0, digits.size() - std::min(digits.size(), extension.size())));
    if (!frame || *frame < 0 || name != fileName(*frame)) return std::nullopt;
    return frame;
}

bool isRunFile(const fs::path& file) {
    return kPictureNames.frameOf(file) || kStateNames.frameOf(file) || kCheckpointNames.frameOf(file) ||
           file.filename() == "manifest.json" || file.filename() == "run.json";
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return files;
}

}  // namespace tools
