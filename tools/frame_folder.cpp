// Every file is written whole before the manifest lists it, so a run may end at any moment.
#include "tools/frame_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "engine/checkpoint.h"
#include "render/system_error.h"
#include "tools/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// One to go on from, and one more for when the newest is damaged or lies after a damaged frame.
constexpr std::size_t kCheckpoints = 2;

constexpr const char* kCheckpointPrefix = "checkpoint-";
constexpr const char* kCheckpointExtension = ".state";

/// Whether a file is called prefix, digits, extension.
bool isNumbered(const fs::path& file, std::string_view prefix, std::string_view extension) {
    const std::string name = file.filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(extension)) return false;
    const std::string_view digits =
        std::string_view(name).substr(prefix.size(), name.size() - prefix.size() - extension.size());
    return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
}

void removeFile(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error) throw render::SystemError(fmt::format("cannot remove {}: {}", path.string(), error.message()));
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return files;
}

}  // namespace

FrameFolder::FrameFolder(const FolderOptions& options, FrameNames names, const nlohmann::ordered_json& identity)
    : folder_(options.path), names_(std::move(names)), warn_(options.warn) {
    createFolder(folder_);
    hold();
    removeHalfWritten();
    const fs::path path = folder_ / "manifest.json";
    if (options.existing == Existing::overwrite) {
        removeAll();
    } else if (fs::exists(path)) {
        manifest_ = decodeManifest(readFile(path), path.string());
        const std::string different = differences(manifest_.identity, identity);
        if (!different.empty())
            throw render::SystemError(
                fmt::format("{} holds frames of another run ({}); choose another folder, or --overwrite them",
                            folder_.string(), different));
    } else if (hasFrames()) {
        throw render::SystemError(
            fmt::format("{} holds frames of a run that left no manifest.json; choose another folder, or "
                        "--overwrite them",
                        folder_.string()));
    }
    manifest_.identity = identity;
    if (options.existing == Existing::keep) keepWhole();
    writeManifest();
}

FrameFolder::~FrameFolder() {
    if (hold_ >= 0) ::close(hold_);
}

/// The lock is the system's: it goes with the process, however that ends.
void FrameFolder::hold() {
    hold_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (hold_ < 0)
        throw render::SystemError(fmt::format("cannot open folder {}: {}", folder_.string(), std::strerror(errno)));
    if (::flock(hold_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    ::close(hold_);
    if (error == EWOULDBLOCK)
        throw render::SystemError(fmt::format("another run is writing into {}", folder_.string()));
    throw render::SystemError(fmt::format("cannot lock folder {}: {}", folder_.string(), std::strerror(error)));
}

/// What a run that was killed was writing.
void FrameFolder::removeHalfWritten() const {
    for (const fs::path& file : filesIn(folder_)) {
        const std::string name = file.filename().string();
        if (name.starts_with(".") && name.ends_with(".partial")) removeFile(file);
    }
}

bool FrameFolder::isFrame(const fs::path& file) const {
    return isNumbered(file, names_.prefix, names_.extension);
}

bool FrameFolder::hasFrames() const {
    const auto files = filesIn(folder_);
    return std::any_of(files.begin(), files.end(), [&](const fs::path& file) { return isFrame(file); });
}

void FrameFolder::removeAll() {
    for (const fs::path& file : filesIn(folder_))
        if (isFrame(file) || isNumbered(file, kCheckpointPrefix, kCheckpointExtension)) removeFile(file);
    removeFile(folder_ / "run.json");
    removeFile(folder_ / "manifest.json");
}

void FrameFolder::keepWhole() {
    for (const auto& [frame, record] : manifest_.frames) {
        const fs::path path = pathOf(frame);
        if (!fs::exists(path))
            warn_(fmt::format("{} is missing and will be made again", path.string()));
        else if (checksumOf(readFile(path)) != record.checksum)
            warn_(fmt::format("{} is damaged and will be made again", path.string()));
        else
            kept_[frame] = record;
    }
    manifest_.frames = kept_;
}

fs::path FrameFolder::pathOf(int frame) const {
    return folder_ / fmt::format("{}{:05}{}", names_.prefix, frame, names_.extension);
}

fs::path FrameFolder::checkpointPath(int frame) const {
    return folder_ / fmt::format("{}{:05}{}", kCheckpointPrefix, frame, kCheckpointExtension);
}

std::optional<Restart> FrameFolder::restart(const engine::Setup& setup, int latest) const {
    for (auto record = manifest_.checkpoints.rbegin(); record != manifest_.checkpoints.rend(); ++record) {
        if (record->frame > latest) continue;
        const fs::path path = checkpointPath(record->frame);
        try {
            const auto bytes = readFile(path);
            if (checksumOf(bytes) != record->checksum) throw engine::CheckpointError("it is damaged or cut short");
            return Restart{record->frame, engine::decodeCheckpoint(setup, bytes), record->report};
        } catch (const std::exception& error) {
            warn_(fmt::format("cannot go on from {}: {}", path.string(), error.what()));
        }
    }
    return std::nullopt;
}

void FrameFolder::write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash) {
    writeFile(pathOf(frame), bytes);
    manifest_.frames[frame] = {checksumOf(bytes), stateHash};
}

void FrameFolder::writeCheckpoint(int frame, std::span<const std::uint8_t> bytes,
                                  const nlohmann::ordered_json& report) {
    writeFile(checkpointPath(frame), bytes);
    auto& checkpoints = manifest_.checkpoints;
    std::erase_if(checkpoints, [&](const CheckpointRecord& record) { return record.frame >= frame; });
    checkpoints.push_back({frame, checksumOf(bytes), report});
    if (checkpoints.size() > kCheckpoints) checkpoints.erase(checkpoints.begin());
    writeManifest();
    removeUnlistedCheckpoints();
}

void FrameFolder::writeManifest() const {
    writeFile(folder_ / "manifest.json", encodeManifest(manifest_));
}

void FrameFolder::removeUnlistedCheckpoints() const {
    for (const fs::path& file : filesIn(folder_)) {
        if (!isNumbered(file, kCheckpointPrefix, kCheckpointExtension)) continue;
        if (std::none_of(manifest_.checkpoints.begin(), manifest_.checkpoints.end(),
                         [&](const CheckpointRecord& record) { return checkpointPath(record.frame) == file; }))
            removeFile(file);
    }
}

}  // namespace tools
