// A file is complete before the manifest lists it, so that a run can be resumed after ending at any moment.
#include "tools/run/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "engine/run/checkpoint.h"
#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// How many checkpoints are kept. Chosen: one to resume from, and one more in case the newest is damaged or lies after
/// a damaged frame.
constexpr std::ptrdiff_t kCheckpointCount = 2;

/// Time between two writes of the manifest. Chosen: a killed run loses at most the frames of this time, because frames
/// that the manifest does not list are made again.
constexpr std::chrono::seconds kManifestInterval{1};

void removeFile(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error) throw render::SystemError(fmt::format("cannot remove {}: {}", path.string(), error.message()));
}

bool isCheckpoint(const fs::path& file) {
    std::array<char, engine::kCheckpointMark.size()> beginning{};
    std::ifstream(file, std::ios::binary).read(beginning.data(), beginning.size());
    return std::string_view(beginning.data(), beginning.size()) == engine::kCheckpointMark;
}

/// Whether a run.json has the fields that runJson() gives it. Other programs have files of the same name.
bool isRunReport(const fs::path& file) {
    const Json json = Json::parse(readFile(file), nullptr, false);
    return json.is_object() && json.contains("scene_hash") && json.contains("state_hash");
}

[[noreturn]] void failForeign(const fs::path& file) {
    throw scenes::InputError(file.string(),
                             "this file was not written by a run into this folder; choose another folder or remove it");
}

}  // namespace

FrameFolder::FrameFolder(const FolderOptions& options, FrameNames names, const FrameList& frames, const Json& identity)
    : folder_(options.path),
      lock_(folder_),
      resumes_(options.resume),
      checkpointSeconds_(options.checkpointSeconds),
      names_(names) {
    const fs::path path = folder_ / "manifest.json";
    bool isDamaged = false;
    if (fs::exists(path)) {
        const auto text = readFile(path);
        if (!isManifest(text)) failForeign(path);
        try {
            manifest_ = decodeManifest(text, path.string());
        } catch (const render::SystemError&) {
            if (!options.overwrite) throw;
            isDamaged = true;
        }
        const std::string different = options.overwrite ? "" : differences(manifest_.identity, identity);
        if (!different.empty())
            throw render::SystemError(
                fmt::format("{} holds frames of another run ({}); choose another folder, or --overwrite them",
                            folder_.string(), different));
    }
    requireOwnFiles(isDamaged);
    if (options.overwrite) removeFrames();
    manifest_.identity = identity;
    const auto [first, last] = manifest_.planned.value_or(std::pair(frames.first(), frames.last()));
    manifest_.planned = {std::min(first, frames.first()), std::max(last, frames.last())};
    render::removeAbandonedFiles(folder_, isRunFile);
    if (resumes_) keepIntactFrames();
    writeManifest();
}

/// Makes sure that every file whose name the run may use was written by a run into this folder.
/// @param isDamaged  whether the manifest can no longer tell which frames were
void FrameFolder::requireOwnFiles(bool isDamaged) const {
    // A manifest of `render` lists pictures, one of `simulate` particle states.
    const FrameNames& listed = manifest_.identity.contains("size") ? kPictureNames : kStateNames;
    for (const fs::path& file : filesIn(folder_)) {
        std::optional<int> frame = kPictureNames.frameOf(file);
        if (!frame) frame = kStateNames.frameOf(file);
        const bool isOwn = frame ? isDamaged || (manifest_.lists(*frame) && listed.frameOf(file))
                           : kCheckpointNames.frameOf(file) ? isCheckpoint(file)
                           : file.filename() == "run.json"  ? isRunReport(file)
                                                            : true;
        if (!isOwn) failForeign(file);
    }
}

/// Removes all that earlier runs have left. The manifest goes last, so that it lists what is left if this fails.
void FrameFolder::removeFrames() {
    for (const fs::path& file : filesIn(folder_))
        if (isRunFile(file) && file.filename() != "manifest.json") removeFile(file);
    manifest_ = {};
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
        } catch (const std::bad_alloc&) {
            throw;  // an earlier checkpoint would need as much
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
        if (const auto old = kCheckpointNames.frameOf(file); old && all.count(*old) == 0 && isCheckpoint(file))
            removeFile(file);
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
