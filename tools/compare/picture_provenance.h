// Where a picture comes from: the scene, the particle state and the renderer. This is recorded in the picture's sidecar
// (a JSON file beside it), in the manifest of its folder, or in the run.json of its run. `compare` reads these files to
// tell whether the simulation or the renderer changed; `approve` writes sidecars.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "tools/run/run_report.h"
#include "tools/system/json.h"

namespace tools {

/// What is recorded about the origin of a picture. A text is empty if it is not recorded.
struct PictureProvenance {
    std::string source;  ///< path of the JSON file that has the record
    std::string sceneHash;
    std::string stateHash;  ///< hash of the particles that the picture shows
    std::string version;
    RendererRecord renderer;
    std::string quality;
    std::string note;  ///< why a file that should have the record does not have it
};

/// Path of the sidecar of a picture: PICTURE.json beside PICTURE.png.
std::filesystem::path sidecarPath(const std::filesystem::path& picture);

/// Reads the first that exists of the sidecar, the folder's manifest.json and its run.json (which has no states of
/// single frames). A sidecar or manifest whose checksum is not that of the bytes is skipped with a note. Never throws
/// because of what these files contain.
/// @param bytes  the content of the picture's file
PictureProvenance provenanceOf(const std::filesystem::path& picture, std::span<const std::uint8_t> bytes);

/// What the JSON of a sidecar, manifest or run.json records of the renderer. Where it names OpenGL's renderer and no
/// other, a version up to 0.4.0 has drawn the picture on the CPU and copied it through OpenGL.
RendererRecord rendererIn(const nlohmann::json& json);

/// What drew a picture in words, such as "OpenGL (llvmpipe, 4.5 Mesa 22.3.6)".
std::string textOf(const RendererRecord& renderer);

/// Whether OpenGL drew both pictures on the same renderer and version of the driver. Then the same particles and scene
/// are the same bytes; other drivers round differently.
bool haveSameDriver(const PictureProvenance& one, const PictureProvenance& other);

/// The content of the sidecar of a picture; values that are not known are null.
/// @param checksum  checksum of the picture's file
/// @param width, height  size of the picture in pixels
Json sidecarJson(const PictureProvenance& provenance, const std::string& checksum, int width, int height);

/// The JSON in a file; null if the file cannot be read or is not JSON. Its members are sorted, so that looking up one
/// of the thousands of frames of a manifest is fast.
nlohmann::json readJson(const std::filesystem::path& path);

/// The part of the program whose change makes a picture differ from its golden.
enum class Cause { simulation, renderer, unknown };

struct Explanation {
    Cause cause = Cause::unknown;
    std::string text;
};

/// Compares the state hashes of two pictures. States are the same bits on every machine, so that equal hashes leave
/// only the renderer as the cause of a difference, and different hashes mean that the simulation or the scene changed.
Explanation explain(const PictureProvenance& actual, const PictureProvenance& expected);

}  // namespace tools
