// A file is complete before the manifest lists it, so that a run can be resumed after ending at any moment.
#include "tools/run/frame_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "engine/run/checkpoint.h"
#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// How many checkpoints are kept. Chosen: one to resume from, and one more in case the newest is damaged or lies after
/// a damaged frame.
constexpr std::ptrdiff_t kCheckpointCount = 2;

/// Time between two writes of the manifest. Chosen: a killed run loses at most the frames of this time, because frames
/// that the manifest does not list are made again.
constexpr std::chrono::seconds kManifestInterval{1};

constexpr FrameNames kCheckpointNames = {"checkpoint-", ".state"};

void removeFile(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error) throw render::SystemError(fmt::format("cannot remove {}: {}", path.string(), error.message()));
}

bool isFrame(const fs::path& file) {
    return kPictureNames.frameOf(file) || kStateNames.frameOf(file);
}

/// Whether a run leaves a file of this name in its folder.
bool isRunFile(const fs::path& file) {
    return isFrame(file) || kCheckpointNames.frameOf(file) || file.filename() == "manifest.json" ||
           file.filename() == "run.json";
}

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

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return files;
}

FolderLock::FolderLock(const fs::path& folder) {
    createFolder(folder);
    descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0)
        throw render::SystemError(fmt::format("cannot open folder {}: {}", folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(descriptor_);
    if (error == EWOULDBLOCK) throw render::SystemError(fmt::format("another run is writing into {}", folder.string()));
    throw render::SystemError(fmt::format("cannot lock folder {}: {}", folder.string(), std::strerror(error)));
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

FrameFolder::FrameFolder(const FolderOptions& options, FrameNames names, const Json& identity)
    : folder_(options.path),
      lock_(folder_),
      resumes_(options.resume),
      checkpointSeconds_(options.checkpointSeconds),
      names_(names) {
    const fs::path path = folder_ / "manifest.json";
    if (options.overwrite) {
        for (const fs::path& file : filesIn(folder_))
            if (isRunFile(file)) removeFile(file);
    } else if (fs::exists(path)) {
        manifest_ = decodeManifest(readFile(path), path.string());
        const std::string different = differences(manifest_.identity, identity);
        if (!different.empty())
            throw render::SystemError(
                fmt::format("{} holds frames of another run ({}); choose another folder, or --overwrite them",
                            folder_.string(), different));
    } else if (std::ranges::any_of(filesIn(folder_), isFrame)) {
        throw render::SystemError(
            fmt::format("{} holds frames of a run that left no manifest.json; choose another folder, or "
                        "--overwrite them",
                        folder_.string()));
    }
    manifest_.identity = identity;
    render::removeAbandonedFiles(folder_, isRunFile);
    if (resumes_) keepIntactFrames();
    writeManifest();
}

FrameFolder::~FrameFolder() {
    try {
        if (!isManifestCurrent_) writeManifest();
    } catch (const render::SystemError&) {
        // The frames that the manifest on disk does not list will be made again.
    }
}

void FrameFolder::keepIntactFrames() {
    for (const auto& [frame, record] : manifest_.frames) {
        const fs::path path = pathOf(frame);
        if (!fs::exists(path))
            printWarning(fmt::format("{} is missing: it does not count as done", path.string()));
        else if (checksumOf(readFile(path)) != record.checksum)
            printWarning(fmt::format("{} is damaged: it does not count as done", path.string()));
        else
            kept_[frame] = record;
    }
    manifest_.frames = kept_;
}

fs::path FrameFolder::pathOf(int frame) const {
    return folder_ / names_.fileName(frame);
}

std::optional<RestartPoint> FrameFolder::restartPoint(const engine::Setup& setup, int latest) const {
    if (!resumes_) return std::nullopt;
    for (auto next = manifest_.checkpoints.upper_bound(latest); next != manifest_.checkpoints.begin();) {
        const auto& [frame, record] = *--next;
        const fs::path path = folder_ / kCheckpointNames.fileName(frame);
        try {
            const auto bytes = readFile(path);
            if (checksumOf(bytes) != record.checksum) throw engine::CheckpointError("it is damaged or truncated");
            return RestartPoint{frame, engine::decodeCheckpoint(setup, bytes), record.report};
        } catch (const std::exception& error) {
            printWarning(fmt::format("cannot resume from {}: {}", path.string(), error.what()));
        }
    }
    return std::nullopt;
}

void FrameFolder::write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash) {
    writeFile(pathOf(frame), bytes);
    manifest_.frames[frame] = {checksumOf(bytes), stateHash};
    isManifestCurrent_ = false;
    if (std::chrono::steady_clock::now() - lastManifest_ > kManifestInterval) writeManifest();
}

void FrameFolder::writeCheckpoint(int frame, std::span<const std::uint8_t> bytes, const Json& report) {
    writeFile(folder_ / kCheckpointNames.fileName(frame), bytes);
    auto& all = manifest_.checkpoints;
    all[frame] = {checksumOf(bytes), report};
    // A longer run may have left checkpoints after this frame. The newest is kept, for that run to resume from.
    const auto later = all.upper_bound(frame);
    if (later != all.end()) all.erase(later, std::prev(all.end()));
    while (std::distance(all.begin(), all.upper_bound(frame)) > kCheckpointCount) all.erase(all.begin());
    writeManifest();
    for (const fs::path& file : filesIn(folder_))
        if (const auto old = kCheckpointNames.frameOf(file); old && all.count(*old) == 0) removeFile(file);
}

void FrameFolder::writeReport(const Json& json) const {
    writeFile(folder_ / "run.json", indentedText(json));
}

void FrameFolder::writeManifest() {
    writeFile(folder_ / "manifest.json", encodeManifest(manifest_));
    isManifestCurrent_ = true;
    lastManifest_ = std::chrono::steady_clock::now();
}

}  // namespace tools
