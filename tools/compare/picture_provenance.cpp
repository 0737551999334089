// Reads JSON files that may be absent, broken or about another picture.
#include "tools/compare/picture_provenance.h"

#include <fmt/format.h>

#include <string_view>

#include "render/output/atomic_file.h"
#include "render/picture/system_error.h"
#include "tools/frames/manifest.h"
#include "tools/run/options.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

std::string textIn(const nlohmann::json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

/// The fields that sidecars, manifests and run.json have in common.
PictureProvenance commonProvenance(const nlohmann::json& json, const fs::path& source) {
    PictureProvenance provenance;
    provenance.source = source.string();
    provenance.sceneHash = textIn(json, "scene_hash");
    provenance.version = textIn(json, "version");
    provenance.renderer = rendererIn(json);
    provenance.quality = textIn(json, "quality");
    return provenance;
}

/// "00012" for frame-00012.png, the frame's key in a manifest; empty for other names.
std::string frameKey(const fs::path& picture) {
    const std::string stem = picture.stem().string();
    return stem.starts_with("frame-") ? stem.substr(6) : std::string{};
}

PictureProvenance aboutOtherBytes(const fs::path& source) {
    PictureProvenance provenance;
    provenance.note = fmt::format("{} is about another picture than the one that is there", source.string());
    return provenance;
}

/// The provenance that a picture's sidecar records. Its source is empty if there is no sidecar with this checksum.
PictureProvenance sidecarProvenance(const fs::path& picture, const std::string& checksum) {
    const fs::path path = sidecarPath(picture);
    const nlohmann::json json = readJson(path);
    if (!json.is_object() || textIn(json, "png").empty()) return {};
    if (textIn(json, "png") != checksum) return aboutOtherBytes(path);
    PictureProvenance provenance = commonProvenance(json, path);
    provenance.stateHash = textIn(json, "state_hash");
    return provenance;
}

PictureProvenance manifestProvenance(const fs::path& picture, const std::string& checksum) {
    const fs::path path = picture.parent_path() / "manifest.json";
    const nlohmann::json json = readJson(path);
    if (!json.is_object() || !json.contains("frames") || !json["frames"].is_object()) return {};
    const auto frame = json["frames"].find(frameKey(picture));
    if (frame == json["frames"].end() || !frame->is_object()) return {};
    if (textIn(*frame, "checksum") != checksum) return aboutOtherBytes(path);
    PictureProvenance provenance = commonProvenance(json.value("run", nlohmann::json::object()), path);
    provenance.stateHash = textIn(*frame, "state_hash");
    return provenance;
}

PictureProvenance runProvenance(const fs::path& picture) {
    const fs::path path = picture.parent_path() / "run.json";
    const nlohmann::json json = readJson(path);
    if (!json.is_object() || textIn(json, "scene_hash").empty()) return {};
    return commonProvenance(json, path);
}

Json textOrNull(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

/// A clause such as "; GL renderer A instead of B" if both values are known and differ, else an empty text.
std::string changeOf(const char* what, const std::string& actual, const std::string& expected) {
    if (actual.empty() || expected.empty() || actual == expected) return {};
    return fmt::format("; {} {} instead of {}", what, actual, expected);
}

std::string whyUnknown(const char* side, const PictureProvenance& provenance) {
    if (!provenance.stateHash.empty()) return {};
    return fmt::format("; the {} picture's state is not recorded{}", side,
                       provenance.note.empty() ? "" : ": " + provenance.note);
}

}  // namespace

RendererRecord rendererIn(const nlohmann::json& json) {
    const std::string name = textIn(json, "renderer");
    const std::string glRenderer = textIn(json, "gl_renderer");
    if (name.empty()) return {glRenderer.empty() ? "" : kRendererNames[0], "", ""};
    return {name, glRenderer, textIn(json, "gl_version")};
}

std::string textOf(const RendererRecord& renderer) {
    if (renderer.name.empty()) return "an unknown renderer";
    if (renderer.name == kRendererNames[0]) return "the CPU";
    if (renderer.name != kRendererNames[1]) return fmt::format("the renderer {}", renderer.name);
    return fmt::format("OpenGL ({}, {})", renderer.glRenderer.empty() ? "unknown" : renderer.glRenderer,
                       renderer.glVersion.empty() ? "unknown version" : renderer.glVersion);
}

bool haveSameDriver(const PictureProvenance& one, const PictureProvenance& other) {
    const RendererRecord& renderer = one.renderer;
    return renderer.name == kRendererNames[1] && !renderer.glRenderer.empty() && !renderer.glVersion.empty() &&
           renderer == other.renderer;
}

fs::path sidecarPath(const fs::path& picture) {
    constexpr std::string_view kExtension = ".json";
    const std::string stem = render::shortenedName(picture.stem().string(), kExtension.size());
    return picture.parent_path() / (stem + std::string(kExtension));
}

nlohmann::json readJson(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) return nullptr;
    try {
        const nlohmann::json json = nlohmann::json::parse(readFile(path), nullptr, false);
        return json.is_discarded() ? nlohmann::json(nullptr) : json;
    } catch (const render::SystemError&) {
        return nullptr;
    }
}

PictureProvenance provenanceOf(const fs::path& picture, std::span<const std::uint8_t> bytes) {
    const std::string checksum = checksumOf(bytes);
    std::string note;
    for (PictureProvenance provenance :
         {sidecarProvenance(picture, checksum), manifestProvenance(picture, checksum), runProvenance(picture)}) {
        if (note.empty()) note = provenance.note;
        if (provenance.source.empty()) continue;
        provenance.note = note;
        return provenance;
    }
    PictureProvenance none;
    none.note = note;
    return none;
}

Json sidecarJson(const PictureProvenance& provenance, const std::string& checksum, int width, int height) {
    Json json = {{"format", 1},
                 {"png", checksum},
                 {"scene_hash", textOrNull(provenance.sceneHash)},
                 {"state_hash", textOrNull(provenance.stateHash)},
                 {"version", textOrNull(provenance.version)}};
    addTo(json, provenance.renderer);
    json["quality"] = textOrNull(provenance.quality);
    json["size"] = {width, height};
    return json;
}

Explanation explain(const PictureProvenance& actual, const PictureProvenance& expected) {
    const std::string others = changeOf("scene", actual.sceneHash, expected.sceneHash) +
                               changeOf("renderer", actual.renderer.name, expected.renderer.name) +
                               changeOf("GL renderer", actual.renderer.glRenderer, expected.renderer.glRenderer) +
                               changeOf("GL version", actual.renderer.glVersion, expected.renderer.glVersion) +
                               changeOf("quality", actual.quality, expected.quality) +
                               changeOf("version", actual.version, expected.version);
    if (actual.stateHash.empty() || expected.stateHash.empty())
        return {Cause::unknown, "whether the simulation or the renderer changed is not known" +
                                    whyUnknown("actual", actual) + whyUnknown("expected", expected) + others};
    if (actual.stateHash != expected.stateHash)
        return {Cause::simulation, fmt::format("the simulation changed: state {} instead of {}{}", actual.stateHash,
                                               expected.stateHash, others)};
    return {Cause::renderer, fmt::format("the drawing changed: the state is the same, {}{}", actual.stateHash, others)};
}

}  // namespace tools
