// The manifest as JSON. Everything that is read is checked, because the file may be damaged or foreign.
#include "tools/frames/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "engine/core/hash.h"
#include "render/picture/system_error.h"
#include "tools/system/json.h"
#include "tools/system/text.h"

namespace tools {
namespace {

/// The version of the format. It changes whenever the meaning of a field changes.
constexpr int kFormat = 1;

/// How every manifest begins.
constexpr std::string_view kBeginning = "{\n \"format\": ";

int frameNumber(const std::string& text) {
    const auto number = parseNumber(text);
    if (!number || *number < 0) throw render::SystemError(fmt::format("\"{}\" is not a frame number", text));
    return *number;
}

/// The frame number in a JSON value. It is checked here, because nlohmann::json would silently convert fractions and
/// huge numbers.
int frameNumber(const Json& json) {
    if (!json.is_number_integer() || json < 0 || json > std::numeric_limits<int>::max())
        throw render::SystemError(fmt::format("{} is not a frame number", compactText(json)));
    return json.get<int>();
}

/// How many bytes of a checkpoint's file are the text of loads.csv.
std::size_t loadBytesOf(const Json& checkpoint) {
    if (!checkpoint.contains("load_bytes")) return 0;
    const Json& bytes = checkpoint["load_bytes"];
    if (!bytes.is_number_unsigned())
        throw render::SystemError(fmt::format("{} is not a number of bytes", compactText(bytes)));
    return bytes.get<std::size_t>();
}

std::map<int, FrameRecord> framesOf(const Json& json) {
    std::map<int, FrameRecord> frames;
    for (const auto& [number, frame] : json.items())
        frames[frameNumber(number)] = {frame.at("checksum").get<std::string>(),
                                       frame.at("state_hash").get<std::string>()};
    return frames;
}

/// A JSON object of frames, a line for each. Building a JSON tree of all of them would take many times the memory.
std::string textOf(const std::map<int, FrameRecord>& frames) {
    std::string text;
    for (const auto& [number, frame] : frames)
        text += fmt::format("{}\n  \"{:05}\": {}", text.empty() ? "" : ",", number,
                            compactText({{"checksum", frame.checksum}, {"state_hash", frame.stateHash}}));
    return "{" + text + "\n }";
}

ChunkRecord chunkRecord(const Json& json) {
    ChunkRecord chunk{json.at("machines"), json.at("report")};
    if (!chunk.machines.is_array()) throw render::SystemError("\"machines\" is not a list");
    for (const Json& machine : chunk.machines)
        if (!machine.is_object()) throw render::SystemError("a machine is not an object");
    if (!chunk.report.is_null() && !chunk.report.is_object()) throw render::SystemError("\"report\" is not an object");
    return chunk;
}

Manifest parsed(const Json& json) {
    if (json.at("format") != kFormat)
        throw render::SystemError(fmt::format("its format is {}, not {}", compactText(json.at("format")), kFormat));
    Manifest manifest;
    manifest.identity = json.at("run");
    if (!manifest.identity.is_object()) throw render::SystemError("\"run\" is not an object");
    if (json.contains("planned"))
        manifest.planned = {frameNumber(json.at("planned").at(0)), frameNumber(json.at("planned").at(1))};
    manifest.asked = json.value("asked", "");
    if (manifest.asked.find_first_not_of("0123456789,-:") != std::string::npos)
        throw render::SystemError("\"asked\" is not a list of frames");
    if (json.contains("chunk")) manifest.chunk = chunkRecord(json.at("chunk"));
    manifest.hasFrames = json.contains("frames");
    if (manifest.hasFrames) manifest.frames = framesOf(json.at("frames"));
    if (json.contains("formats"))
        for (const auto& [format, frames] : json.at("formats").items())
            manifest.otherFormats[format] = framesOf(frames);
    for (const Json& checkpoint : json.at("checkpoints")) {
        if (!checkpoint.at("report").is_object()) throw render::SystemError("a checkpoint's report is not an object");
        manifest.checkpoints[frameNumber(checkpoint.at("frame"))] = {checkpoint.at("checksum").get<std::string>(),
                                                                     checkpoint.at("report"), loadBytesOf(checkpoint)};
    }
    return manifest;
}

std::string textOf(const Json& identity, const std::string& key) {
    return identity.contains(key) ? compactText(identity[key]) : "nothing";
}

}  // namespace

std::string checksumOf(std::span<const std::uint8_t> bytes) {
    return engine::hexadecimal(engine::fnv1aOf(bytes));
}

std::string encodeManifest(const Manifest& manifest) {
    Json checkpoints = Json::array();
    for (const auto& [frame, checkpoint] : manifest.checkpoints) {
        checkpoints.push_back({{"frame", frame}, {"checksum", checkpoint.checksum}, {"report", checkpoint.report}});
        if (checkpoint.loadBytes > 0) checkpoints.back()["load_bytes"] = checkpoint.loadBytes;
    }
    const std::string planned =
        manifest.planned ? fmt::format(" \"planned\": [{}, {}],\n", manifest.planned->first, manifest.planned->second)
                         : "";
    const std::string asked = manifest.asked.empty() ? "" : fmt::format(" \"asked\": \"{}\",\n", manifest.asked);
    const std::string chunk =
        manifest.chunk
            ? fmt::format(" \"chunk\": {},\n",
                          compactText({{"machines", manifest.chunk->machines}, {"report", manifest.chunk->report}}))
            : "";
    std::string lists;
    for (const auto& [format, frames] : manifest.otherFormats)
        lists += fmt::format("{}\n {}: {}", lists.empty() ? "" : ",", compactText(format), textOf(frames));
    const std::string formats = lists.empty() ? "" : fmt::format(",\n \"formats\": {{{}\n }}", lists);
    const std::string frames = manifest.hasFrames ? ",\n \"frames\": " + textOf(manifest.frames) : "";
    return fmt::format("{}{},\n \"run\": {},\n{}{}{} \"checkpoints\": {}{}{}\n}}\n", kBeginning, kFormat,
                       compactText(manifest.identity), planned, asked, chunk, compactText(checkpoints), frames,
                       formats);
}

std::map<int, FrameRecord>& Manifest::framesIn(std::string_view format) {
    if (!format.empty()) return otherFormats[std::string(format)];
    hasFrames = true;
    return frames;
}

const std::map<int, FrameRecord>* Manifest::findFrames(std::string_view format) const {
    if (format.empty()) return hasFrames ? &frames : nullptr;
    const auto other = otherFormats.find(format);
    return other == otherFormats.end() ? nullptr : &other->second;
}

bool Manifest::lists(int frame, std::string_view format) const {
    const auto* written = findFrames(format);
    return written != nullptr &&
           (written->count(frame) == 1 || (planned && planned->first <= frame && frame <= planned->second));
}

bool isManifest(std::span<const std::uint8_t> text) {
    return text.size() >= kBeginning.size() && std::equal(kBeginning.begin(), kBeginning.end(), text.begin());
}

Manifest decodeManifest(std::span<const std::uint8_t> text, const std::string& name) {
    try {
        return parsed(Json::parse(text.begin(), text.end()));
    } catch (const std::exception& error) {
        throw render::SystemError(fmt::format("{} is not a manifest of frames: {}", name, error.what()));
    }
}

std::string differences(const Json& there, const Json& here) {
    Json all = there;
    all.update(here);
    std::string text;
    for (const auto& item : all.items()) {
        const std::string before = textOf(there, item.key());
        const std::string now = textOf(here, item.key());
        if (before != now)
            text += fmt::format("{}{}: {} there, {} here", text.empty() ? "" : "; ", item.key(), before, now);
    }
    return text;
}

}  // namespace tools
