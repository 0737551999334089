// Every file is written whole before the manifest lists it, so a run may end at any moment.
#include "tools/run/frame_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <set>

#include "engine/run/checkpoint.h"
#include "render/picture/system_error.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// One to go on from, and one more for when the newest is damaged or lies after a damaged frame.
constexpr std::ptrdiff_t kCheckpoints = 2;

/// Chosen: what a kill may leave unlisted, and is made again.
constexpr std::chrono::seconds kBetweenListings{1};

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

bool isFrame(const fs::path& file) {
    return isNumbered(file, kPictureNames.prefix, kPictureNames.extension) ||
           isNumbered(file, kStateNames.prefix, kStateNames.extension);
}

bool isCheckpoint(const fs::path& file) {
    return isNumbered(file, kCheckpointPrefix, kCheckpointExtension);
}

/// Every file that a run leaves in its folder.
bool isOurs(const fs::path& file) {
    return isFrame(file) || isCheckpoint(file) || file.filename() == "manifest.json" || file.filename() == "run.json";
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    return files;
}

}  // namespace

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
      resumes_(options.existing == Existing::keep),
      names_(names),
      warn_(options.warn) {
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
    removeHalfWritten();
    if (resumes_) keepWhole();
    writeManifest();
}

FrameFolder::~FrameFolder() {
    try {
        if (!isListed_) writeManifest();
    } catch (const render::SystemError&) {
        // Frames that are not listed are made again.
    }
}

/// What a run that was killed was writing.
void FrameFolder::removeHalfWritten() const {
    constexpr std::string_view kPartial = ".partial";
    for (const fs::path& file : filesIn(folder_)) {
        const std::string name = file.filename().string();
        if (name.starts_with(".") && name.ends_with(kPartial) &&
            isOurs(name.substr(1, name.size() - 1 - kPartial.size())))
            removeFile(file);
    }
}

bool FrameFolder::hasFrames() const {
    const auto files = filesIn(folder_);
    return std::any_of(files.begin(), files.end(), isFrame);
}

void FrameFolder::removeAll() {
    for (const fs::path& file : filesIn(folder_))
        if (isOurs(file)) removeFile(file);
}

void FrameFolder::keepWhole() {
    for (const auto& [frame, record] : manifest_.frames) {
        const fs::path path = pathOf(frame);
        if (!fs::exists(path))
            warn_(fmt::format("{} is missing: it does not count as done", path.string()));
        else if (checksumOf(readFile(path)) != record.checksum)
            warn_(fmt::format("{} is damaged: it does not count as done", path.string()));
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
    if (!resumes_) return std::nullopt;
    for (auto next = manifest_.checkpoints.upper_bound(latest); next != manifest_.checkpoints.begin();) {
        const auto& [frame, record] = *--next;
        const fs::path path = checkpointPath(frame);
        try {
            const auto bytes = readFile(path);
            if (checksumOf(bytes) != record.checksum) throw engine::CheckpointError("it is damaged or cut short");
            return Restart{frame, engine::decodeCheckpoint(setup, bytes), record.report};
        } catch (const std::exception& error) {
            warn_(fmt::format("cannot go on from {}: {}", path.string(), error.what()));
        }
    }
    return std::nullopt;
}

void FrameFolder::write(int frame, std::span<const std::uint8_t> bytes, const std::string& stateHash) {
    writeFile(pathOf(frame), bytes);
    manifest_.frames[frame] = {checksumOf(bytes), stateHash};
    isListed_ = false;
    if (std::chrono::steady_clock::now() - lastListing_ > kBetweenListings) writeManifest();
}

void FrameFolder::writeCheckpoint(int frame, std::span<const std::uint8_t> bytes, const Json& report) {
    writeFile(checkpointPath(frame), bytes);
    auto& all = manifest_.checkpoints;
    all[frame] = {checksumOf(bytes), report};
    // Of those of a run that had come further the newest stays of use to it.
    const auto later = all.upper_bound(frame);
    if (later != all.end()) all.erase(later, std::prev(all.end()));
    while (std::distance(all.begin(), all.upper_bound(frame)) > kCheckpoints) all.erase(all.begin());
    writeManifest();
    removeUnlistedCheckpoints();
}

void FrameFolder::writeManifest() {
    writeFile(folder_ / "manifest.json", encodeManifest(manifest_));
    isListed_ = true;
    lastListing_ = std::chrono::steady_clock::now();
}

void FrameFolder::removeUnlistedCheckpoints() const {
    std::set<fs::path> listed;
    for (const auto& [frame, record] : manifest_.checkpoints) listed.insert(checkpointPath(frame));
    for (const fs::path& file : filesIn(folder_))
        if (isCheckpoint(file) && listed.count(file) == 0) removeFile(file);
}

}  // namespace tools
