// A file is complete before the manifest lists it, so that a run can be resumed after ending at any moment.
#include "tools/run/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/core/hash.h"
#include "engine/run/checkpoint.h"
#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/loads/load_table.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/processors.h"

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

/// Whether a loads.csv begins as LoadTable does.
bool isLoadTable(const fs::path& file) {
    std::string beginning(kLoadsHead.size(), '\0');
    std::ifstream(file, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
    return beginning == kLoadsHead;
}

/// Writes the file of a checkpoint: the state, and after it the text of loads.csv. Returns what the manifest records.
CheckpointRecord writeFileOf(const Checkpoint& checkpoint, const fs::path& path) {
    const std::string& loads = checkpoint.loads;
    render::AtomicFile file(path);
    file.write(checkpoint.state);
    file.write({reinterpret_cast<const std::uint8_t*>(loads.data()), loads.size()});
    file.commit();
    const std::uint64_t hash = engine::fnv1a(loads, engine::fnv1aOf(checkpoint.state));
    return {engine::hexadecimal(hash), checkpoint.report, loads.size()};
}

/// Reads what writeFileOf() has written.
/// @throws std::exception if the file is not as the manifest has it
RestartPoint readCheckpoint(const fs::path& path, int frame, const CheckpointRecord& record,
                            const engine::Setup& setup) {
    const std::vector<std::uint8_t> bytes = readFile(path);
    if (checksumOf(bytes) != record.checksum || bytes.size() < record.loadBytes)
        throw engine::CheckpointError("it is damaged or truncated");
    const auto state = std::span(bytes).first(bytes.size() - record.loadBytes);
    const auto loads = std::span(bytes).last(record.loadBytes);
    return {frame, engine::decodeCheckpoint(setup, state), {loads.begin(), loads.end()}, record.report};
}

/// The names of the frames that a manifest lists: pictures of `render`, meshes of `mesh` or states of `simulate`.
FrameNames namesOf(const Json& identity) {
    if (identity.contains("size")) return kPictureNames;
    if (!identity.contains("mesh")) return kStateNames;
    const Json& mesh = identity["mesh"];
    return meshNames(mesh.is_object() ? mesh.value("format", "") : "");
}

[[noreturn]] void failForeign(const fs::path& file) {
    throw scenes::InputError(file.string(),
                             "this file was not written by a run into this folder; choose another folder or remove it");
}

}  // namespace

FrameFolder::FrameFolder(const FolderOptions& options, std::vector<FrameNames> names, const FrameList& frames,
                         const Json& identity)
    : folder_(options.path),
      chunk_(options.chunk),
      lock_(folder_, options.chunk),
      checkpointPrefix_(checkpointPrefix(options.chunk)),
      resumes_(options.resume),
      checkpointSeconds_(options.checkpointSeconds),
      names_(std::move(names)) {
    manifest_.hasFrames = false;
    // Files are listed before manifests are read: another chunk that starts meanwhile writes its manifest before any
    // frame.
    const std::vector<fs::path> files = filesIn(folder_);
    const bool isDamaged = readManifests(files, options.overwrite, identity);
    requireOwnFiles(files, isDamaged);
    if (options.overwrite) removeFrames();
    manifest_.identity = identity;
    plan(options, frames);
    // Not the files of other chunks: on some network file systems it cannot be seen that another machine writes them.
    render::removeAbandonedFiles(folder_, [&](const std::string& name) {
        if (!chunk_) return isRunFile(name);
        for (const FrameNames& each : names_)
            if (const auto frame = each.frameOf(name)) return frames.indexOf(*frame).has_value();
        return name == manifestName(chunk_) || name.starts_with(checkpointPrefix_);
    });
    for (const FrameNames& each : names_) {
        manifest_.framesIn(each.format);
        if (resumes_) keepIntactFrames(each);
    }
    for (const FrameNames& each : names_)
        if (resumes_) keepFramesOfOthers(frames, each);
    writeManifest();
}

/// Reads all manifests in the folder. Makes sure that they are of the run with this identity, unless that run is going
/// to overwrite the others. Returns whether one is damaged, in which case that run must be going to.
bool FrameFolder::readManifests(const std::vector<fs::path>& files, bool overwrites, const Json& identity) {
    bool isDamaged = false;
    for (const fs::path& path : files) {
        if (!isManifestName(path)) continue;
        const auto text = readFile(path);
        if (!isManifest(text)) failForeign(path);
        Manifest manifest;
        try {
            manifest = decodeManifest(text, path.string());
        } catch (const render::SystemError&) {
            if (!overwrites) throw;
            isDamaged = true;
        }
        const std::string different = overwrites ? "" : differences(manifest.identity, identity);
        if (!different.empty())
            throw render::SystemError(
                fmt::format("{} holds frames of another run ({}); choose another folder, or --overwrite them",
                            folder_.string(), different));
        (path.filename() == manifestName(chunk_) ? manifest_ : others_.emplace_back()) = std::move(manifest);
    }
    return isDamaged;
}

/// Makes sure that every file whose name the run may use was written by a run into this folder.
/// @param isDamaged  whether the manifests can no longer tell which frames were
void FrameFolder::requireOwnFiles(const std::vector<fs::path>& files, bool isDamaged) const {
    const std::vector<FrameNames> all = allFrameNames();
    const auto anyManifest = [&](const auto& holds) { return holds(manifest_) || std::ranges::any_of(others_, holds); };
    const auto isListed = [&](const FrameNames& names, const fs::path& file) {
        return anyManifest([&](const Manifest& manifest) {
            return manifest.lists(*names.frameOf(file), names.format) &&
                   (!names.format.empty() || namesOf(manifest.identity).frameOf(file));
        });
    };
    const auto hasSeries = [](const Manifest& manifest) { return manifest.otherFormats.contains("vtp"); };
    for (const fs::path& file : files) {
        const auto names =
            std::ranges::find_if(all, [&](const FrameNames& each) { return each.frameOf(file).has_value(); });
        const bool isOwn = names != all.end()                  ? isDamaged || isListed(*names, file)
                           : isCheckpointName(file)            ? isCheckpoint(file)
                           : file.filename() == "run.json"     ? isRunReport(file)
                           : file.filename() == kLoadsName     ? isLoadTable(file)
                           : file.filename() == kVtpSeriesName ? isDamaged || anyManifest(hasSeries)
                                                               : true;
        if (!isOwn) failForeign(file);
    }
}

/// Removes all that earlier runs have left. The manifests go last, so that they list what is left if this fails.
void FrameFolder::removeFrames() {
    const std::vector<fs::path> files = filesIn(folder_);
    for (const fs::path& file : files)
        if ((isRunFile(file) && !isManifestName(file)) || isChunkLock(file)) removeFile(file);
    for (const fs::path& file : files)
        if (isManifestName(file) && file.filename() != manifestName(chunk_)) removeFile(file);
    manifest_ = {};
    manifest_.hasFrames = false;
    others_.clear();
}

/// Adds the frames that the run is asked for to the manifest, and what makes them.
void FrameFolder::plan(const FolderOptions& options, const FrameList& frames) {
    const auto [first, last] = manifest_.planned.value_or(std::pair(frames.first(), frames.last()));
    manifest_.planned = {std::min(first, frames.first()), std::max(last, frames.last())};
    std::string asked = chunk_ ? options.allFrames : listText(frames.numbers);
    if (!manifest_.asked.empty()) asked = fmt::format("{},{}", manifest_.asked, asked);
    manifest_.asked = listText(frameList(asked, std::numeric_limits<int>::max()).numbers);
    if (!chunk_) return;
    if (!manifest_.chunk) manifest_.chunk.emplace();
    ChunkRecord& chunk = *manifest_.chunk;
    chunk.report = nullptr;
    const ProcessorKind processor = processorKind();
    const Json machine = {{"cpu_vendor", processor.vendor}, {"cpu", processor.model}};
    // A chunk may be resumed on a machine of another kind.
    if (std::ranges::find(chunk.machines, machine) == chunk.machines.end()) chunk.machines.push_back(machine);
}

FrameFolder::~FrameFolder() {
    try {
        if (!isManifestCurrent_) writeManifest();
    } catch (const render::SystemError&) {
        // The frames that the manifest on disk does not list will be made again.
    }
}

void FrameFolder::keepIntactFrames(const FrameNames& names) {
    std::map<int, FrameRecord> intact;
    for (const auto& [frame, record] : manifest_.framesIn(names.format)) {
        const fs::path path = folder_ / names.fileName(frame);
        if (!fs::exists(path))
            printWarning(fmt::format("{} is missing: it does not count as done", path.string()));
        else if (checksumOf(readFile(path)) != record.checksum)
            printWarning(fmt::format("{} is damaged: it does not count as done", path.string()));
        else
            intact[frame] = record;
    }
    for (const auto& [frame, record] : intact) kept_[names.format].insert(frame);
    manifest_.framesIn(names.format) = std::move(intact);
}

bool FrameFolder::isKept(int frame, const FrameNames& names) const {
    const auto kept = kept_.find(names.format);
    return kept != kept_.end() && kept->second.contains(frame);
}

bool FrameFolder::isKept(int frame) const {
    return std::ranges::all_of(names_, [&](const FrameNames& names) { return isKept(frame, names); });
}

/// Keeps those of the frames that other chunks have made. A chunk does not take them into its own manifest, which says
/// what has drawn its frames.
void FrameFolder::keepFramesOfOthers(const FrameList& frames, const FrameNames& names) {
    for (const Manifest& other : others_) {
        const auto* records = other.findFrames(names.format);
        if (records == nullptr) continue;
        for (const int frame : frames.numbers) {
            const auto record = records->find(frame);
            const fs::path path = folder_ / names.fileName(frame);
            if (isKept(frame, names) || record == records->end() || !fs::exists(path)) continue;
            if (checksumOf(readFile(path)) != record->second.checksum) continue;
            kept_[names.format].insert(frame);
            if (!chunk_) manifest_.framesIn(names.format)[frame] = record->second;
        }
    }
}

fs::path FrameFolder::pathOf(int frame) const {
    return folder_ / names_.front().fileName(frame);
}

std::optional<RestartPoint> FrameFolder::restartPoint(const engine::Setup& setup, int latest) const {
    if (!resumes_) return std::nullopt;
    for (auto next = manifest_.checkpoints.upper_bound(latest); next != manifest_.checkpoints.begin();) {
        const auto& [frame, record] = *--next;
        const fs::path path = folder_ / checkpointNames().fileName(frame);
        try {
            return readCheckpoint(path, frame, record, setup);
        } catch (const std::bad_alloc&) {
            throw;  // an earlier checkpoint would need as much
        } catch (const std::exception& error) {
            printWarning(fmt::format("cannot resume from {}: {}", path.string(), error.what()));
        }
    }
    return std::nullopt;
}

void FrameFolder::write(int frame, const FrameNames& names, std::span<const std::uint8_t> bytes,
                        const std::string& stateHash) {
    writeFile(folder_ / names.fileName(frame), bytes);
    manifest_.framesIn(names.format)[frame] = {checksumOf(bytes), stateHash};
    isManifestCurrent_ = false;
    if (std::chrono::steady_clock::now() - lastManifest_ > kManifestInterval) writeManifest();
}

void FrameFolder::writeCheckpoint(int frame, const Checkpoint& checkpoint) {
    auto& all = manifest_.checkpoints;
    all[frame] = writeFileOf(checkpoint, folder_ / checkpointNames().fileName(frame));
    // A longer run may have left checkpoints after this frame. The newest is kept, for that run to resume from.
    const auto later = all.upper_bound(frame);
    if (later != all.end()) all.erase(later, std::prev(all.end()));
    while (std::distance(all.begin(), all.upper_bound(frame)) > kCheckpointCount) all.erase(all.begin());
    writeManifest();
    for (const fs::path& file : filesIn(folder_))
        if (const auto old = checkpointNames().frameOf(file); old && all.count(*old) == 0 && isCheckpoint(file))
            removeFile(file);
    writeLoads(checkpoint.loads);
}

void FrameFolder::writeLoads(const std::string& text) const {
    if (!chunk_ && !text.empty()) writeFile(folder_ / kLoadsName, text);
}

void FrameFolder::writeReport(const Json& json) {
    if (!chunk_) return writeFile(folder_ / "run.json", indentedText(json));
    manifest_.chunk->report = json;
    writeManifest();
}

void FrameFolder::writeManifest() {
    writeFile(folder_ / manifestName(chunk_), encodeManifest(manifest_));
    if (index_) writeIndex();
    isManifestCurrent_ = true;
    lastManifest_ = std::chrono::steady_clock::now();
}

void FrameFolder::keepIndex(FrameIndex index) {
    index_ = std::move(index);
    writeIndex();
}

void FrameFolder::writeIndex() const {
    std::vector<int> frames;
    for (const auto& [frame, record] : manifest_.otherFormats.at(std::string(index_->names.format)))
        if (fs::exists(folder_ / index_->names.fileName(frame))) frames.push_back(frame);
    writeFile(folder_ / index_->fileName, index_->encode(frames));
}

}  // namespace tools
