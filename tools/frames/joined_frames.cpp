// A frame may be in several manifests: a chunk that was run again in other parts, for example. One record that fits its
// file is enough.
#include "tools/frames/joined_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "render/picture/system_error.h"
#include "tools/frames/chunk.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/frame_names.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct NamedManifest {
    std::string name;
    Manifest manifest;
};

/// Sorts manifests: that of a run of all frames first, then those of chunks, numbers by their value.
std::tuple<int, int> orderOf(const fs::path& path) {
    const std::string name = path.filename().string();
    std::string_view rest = name;
    const Chunk chunk = takeChunkName(rest).value_or(Chunk{0, 0, {}});
    return {chunk.count, chunk.index};
}

std::vector<NamedManifest> manifestsIn(const fs::path& folder) {
    std::vector<fs::path> paths = filesIn(folder);
    paths.erase(std::remove_if(paths.begin(), paths.end(), [](const fs::path& path) { return !isManifestName(path); }),
                paths.end());
    std::ranges::sort(paths, {}, orderOf);
    std::vector<NamedManifest> manifests;
    for (const fs::path& path : paths) {
        manifests.push_back({path.filename().string(), decodeManifest(readFile(path), path.string())});
        const Json& identity = manifests.back().manifest.identity;
        if (!identity.contains("size"))
            throw render::SystemError(fmt::format("{} lists states, not pictures", path.string()));
        const std::string different = differences(manifests.front().manifest.identity, identity);
        if (!different.empty())
            throw render::SystemError(fmt::format("{} holds frames of different runs: {} and {} differ ({})",
                                                  folder.string(), manifests.front().name, manifests.back().name,
                                                  different));
    }
    if (manifests.empty())
        throw render::SystemError(
            fmt::format("{} holds no frames of a run: no manifest.json and no chunk-1-of-N.json", folder.string()));
    return manifests;
}

/// The frames that a manifest is to list when all of its runs are done.
std::vector<int> framesAskedFor(const Manifest& manifest) {
    if (!manifest.asked.empty()) return frameList(manifest.asked, std::numeric_limits<int>::max()).numbers;
    std::vector<int> frames;  // an earlier version does not say; what it has is all that is known
    for (const auto& [frame, record] : manifest.frames) frames.push_back(frame);
    return frames;
}

void addUnlessThere(Json& list, const Json& item) {
    if (std::ranges::find(list, item) == list.end()) list.push_back(item);
}

/// The formats that any of the runs was asked for.
std::vector<FrameNames> formatsAskedFor(const std::vector<NamedManifest>& manifests) {
    std::vector<FrameNames> asked;
    for (const render::PictureFormat& format : render::pictureFormats()) {
        const FrameNames names = pictureNames(format);
        const auto has = [&](const NamedManifest& each) { return each.manifest.findFrames(names.format) != nullptr; };
        if (std::ranges::any_of(manifests, has)) asked.push_back(names);
    }
    return asked;
}

/// What the manifests record of a frame's file.
std::vector<FrameRecord> recordsOf(const std::vector<NamedManifest>& manifests, int frame, const FrameNames& names) {
    std::vector<FrameRecord> records;
    for (const NamedManifest& each : manifests)
        if (const auto* frames = each.manifest.findFrames(names.format); frames != nullptr && frames->contains(frame))
            records.push_back(frames->at(frame));
    return records;
}

enum class FileState { whole, missing, damaged };

/// Compares a frame's file with what the manifests record of it. The record that fits goes to the joined manifest.
FileState joinFile(const std::vector<NamedManifest>& manifests, int frame, const FrameNames& names,
                   const fs::path& folder, Manifest& joined) {
    const fs::path path = folder / names.fileName(frame);
    const std::vector<FrameRecord> records = recordsOf(manifests, frame, names);
    if (records.empty() || !fs::exists(path)) return FileState::missing;
    const auto fitting = std::ranges::find(records, checksumOf(readFile(path)), &FrameRecord::checksum);
    if (fitting == records.end()) return FileState::damaged;
    joined.framesIn(names.format)[frame] = *fitting;
    return FileState::whole;
}

/// Compares all files of a frame with what the manifests record of them.
void joinFrame(const std::vector<NamedManifest>& manifests, int frame, const std::vector<FrameNames>& formats,
               const fs::path& folder, JoinedFrames& joined) {
    FileState state = FileState::whole;
    for (const FrameNames& names : formats)
        state = std::max(state, joinFile(manifests, frame, names, folder, joined.manifest));
    auto& frames = state == FileState::whole     ? joined.whole
                   : state == FileState::missing ? joined.missing
                                                 : joined.damaged;
    frames.push_back(frame);
}

/// The hash of the particles at the last frame that is whole; empty if there is none.
std::string lastStateHash(const JoinedFrames& joined) {
    if (joined.whole.empty()) return "";
    const int last = joined.whole.back();
    for (const render::PictureFormat& format : render::pictureFormats())
        if (const auto* frames = joined.manifest.findFrames(pictureNames(format).format))
            return frames->at(last).stateHash;
    return "";
}

/// Sum of one of the seconds of all reports.
double secondsOf(const Json& reports, const char* stage) {
    double sum = 0.0;
    for (const Json& report : reports) {
        const Json seconds = report.value("seconds", Json::object());
        if (seconds.is_object() && seconds.contains(stage) && seconds[stage].is_number())
            sum += seconds[stage].get<double>();
    }
    return sum;
}

}  // namespace

std::vector<int> JoinedFrames::toDraw() const {
    std::vector<int> frames;
    std::ranges::merge(missing, damaged, std::back_inserter(frames));
    return frames;
}

JoinedFrames joinFrames(const fs::path& folder, const std::optional<FrameList>& wanted) {
    const std::vector<NamedManifest> manifests = manifestsIn(folder);
    JoinedFrames joined;
    joined.manifest.identity = manifests.front().manifest.identity;
    std::set<int> frames;
    if (wanted) frames.insert(wanted->numbers.begin(), wanted->numbers.end());
    for (const NamedManifest& each : manifests) {
        const std::vector<int> asked = framesAskedFor(each.manifest);
        if (!wanted) frames.insert(asked.begin(), asked.end());
        if (!each.manifest.chunk) {
            joined.manifest.checkpoints = each.manifest.checkpoints;
            continue;
        }
        joined.chunks.push_back(each.name);
        for (const Json& machine : each.manifest.chunk->machines) addUnlessThere(joined.machines, machine);
        if (!each.manifest.chunk->report.is_null()) joined.reports.push_back(each.manifest.chunk->report);
    }
    const std::vector<FrameNames> formats = formatsAskedFor(manifests);
    joined.manifest.hasFrames = false;
    for (const FrameNames& names : formats) joined.manifest.framesIn(names.format);
    for (const int frame : frames) joinFrame(manifests, frame, formats, folder, joined);
    joined.manifest.asked = listText({frames.begin(), frames.end()});
    if (!frames.empty()) joined.manifest.planned = {*frames.begin(), *frames.rbegin()};
    return joined;
}

std::string machineWarning(const JoinedFrames& joined) {
    if (joined.manifest.identity.value("renderer", Json()) != "opengl") return {};
    std::set<std::string> vendors;
    for (const Json& machine : joined.machines) {
        const Json vendor = machine.value("cpu_vendor", Json());
        if (vendor.is_string()) vendors.insert(vendor.get<std::string>());
    }
    if (vendors.size() < 2) return {};
    return fmt::format("the frames were drawn by OpenGL on CPUs of {}: their last bits may differ",
                       fmt::join(vendors, " and "));
}

Json joinedReport(const JoinedFrames& joined) {
    Json json = joined.manifest.identity;
    for (const char* key : {"source", "drawn_from", "depth"})
        for (const Json& report : joined.reports)
            if (!json.contains(key) && report.contains(key)) json[key] = report[key];
    json["assembled_from"] = joined.chunks;
    json["machines"] = joined.machines;
    json["frames"] = joined.whole.size();
    Json& seconds = json["seconds"] = Json::object();
    for (const char* stage : {"simulating", "reading", "drawing", "encoding", "all"})
        seconds[stage] = secondsOf(joined.reports, stage);
    json["state_hash"] = lastStateHash(joined);
    return json;
}

}  // namespace tools
