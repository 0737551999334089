// What is known of how a picture came about: from the sidecar beside it, the manifest of its folder, or the run's
// run.json. `compare` reads them to say whether the simulation or the renderer changed, `approve` writes the sidecars.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "tools/system/json.h"

namespace tools {

/// Texts are empty where nothing says.
struct PictureProvenance {
    std::string source;  ///< the file that says so
    std::string sceneHash;
    std::string stateHash;  ///< of the particles that the picture shows
    std::string version;
    std::string glRenderer;
    std::string quality;
    std::string note;  ///< why a file that should say does not
};

/// PICTURE.json beside PICTURE.png, where `approve` writes it.
std::filesystem::path sidecarPath(const std::filesystem::path& picture);

/// Reads, in this order, the sidecar, the folder's manifest.json and its run.json (which knows no state of single
/// frames). A sidecar or manifest that speaks of other bytes than the picture's is passed over with a note. Never
/// throws for what these files say.
PictureProvenance provenanceOf(const std::filesystem::path& picture, std::span<const std::uint8_t> bytes);

/// The content of a sidecar; unknown provenance are null. Shape: size as width, height.
Json sidecarJson(const PictureProvenance& provenance, const std::string& checksum, int width, int height);

/// The JSON in a file; null where it cannot be read or is none.
nlohmann::json readJson(const std::filesystem::path& path);

/// Which part of the program gave another picture.
enum class Cause { simulation, renderer, unknown };

struct Explanation {
    Cause cause = Cause::unknown;
    std::string text;
};

/// States are the same bits everywhere, so that equal hashes leave only the drawing, and different ones convict the
/// simulation or the scene.
Explanation explain(const PictureProvenance& actual, const PictureProvenance& expected);

}  // namespace tools
