// Numbers in file names have at least five digits, so that the names of most runs sort like the frames.
#include "tools/frames/frame_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "render/picture/system_error.h"
#include "tools/system/text.h"

namespace tools {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kManifestName = "manifest.json";
constexpr std::string_view kChunkManifestExtension = ".json";
constexpr std::string_view kCheckpointPrefix = "checkpoint-";

constexpr std::array<FrameNames, 3> kMeshNames = {{{"mesh-", ".ply"}, {"mesh-", ".obj"}, {"mesh-", ".vdb"}}};

}  // namespace

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

std::string checkpointPrefix(const std::optional<Chunk>& chunk) {
    return chunk ? fmt::format("{}-{}", nameOf(*chunk), kCheckpointPrefix) : std::string(kCheckpointPrefix);
}

bool isCheckpointName(const fs::path& file) {
    const std::string name = file.filename().string();
    std::string_view rest = name;
    if (takeChunkName(rest)) {
        if (!rest.starts_with('-')) return false;
        rest.remove_prefix(1);
    }
    return FrameNames{kCheckpointPrefix, kCheckpointExtension}.frameOf(fs::path(rest)).has_value();
}

std::string manifestName(const std::optional<Chunk>& chunk) {
    return chunk ? fmt::format("{}{}", nameOf(*chunk), kChunkManifestExtension) : std::string(kManifestName);
}

bool isManifestName(const fs::path& file) {
    const std::string name = file.filename().string();
    std::string_view rest = name;
    return takeChunkName(rest) ? rest == kChunkManifestExtension : rest == kManifestName;
}

FrameNames pictureNames(const render::PictureFormat& format) {
    const bool isDefault = &format == render::pictureFormats().data();
    return {kPictureNames.prefix, format.extension, isDefault ? std::string_view() : format.name};
}

FrameNames stateNames(const scenes::ParticleFormat& format) {
    const bool isDefault = &format == scenes::particleFormats().data();
    return {format.prefix, format.extension, isDefault ? std::string_view() : format.name};
}

FrameNames meshNames(std::string_view format) {
    const auto names =
        std::ranges::find_if(kMeshNames, [&](const FrameNames& each) { return each.extension.substr(1) == format; });
    return names == kMeshNames.end() ? kMeshNames.front() : *names;
}

std::vector<FrameNames> allFrameNames() {
    std::vector<FrameNames> all = {kFieldNames};
    all.insert(all.end(), kMeshNames.begin(), kMeshNames.end());
    for (const render::PictureFormat& format : render::pictureFormats()) all.push_back(pictureNames(format));
    for (const scenes::ParticleFormat& format : scenes::particleFormats()) all.push_back(stateNames(format));
    return all;
}

bool isRunFile(const fs::path& file) {
    const std::vector<FrameNames> names = allFrameNames();
    return std::ranges::any_of(names, [&](const FrameNames& each) { return each.frameOf(file).has_value(); }) ||
           isCheckpointName(file) || isManifestName(file) || file.filename() == "run.json" ||
           file.filename() == kLoadsName || file.filename() == kVtpSeriesName;
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return files;
}

}  // namespace tools
