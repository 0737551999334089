// manifest.json: what a folder of frames holds. It says which run the frames belong to, so that those of another are
// never mixed in, and has a checksum of every frame and checkpoint, so that a damaged one is noticed.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "tools/system/json.h"

namespace tools {

/// One frame's file.
struct FrameRecord {
    std::string checksum;   ///< of the file's bytes, checksumOf
    std::string stateHash;  ///< of the particles that it shows
};

/// A state to go on from.
struct CheckpointRecord {
    std::string checksum;  ///< of the file's bytes
    Json report;           ///< what the run had measured by then
};

struct Manifest {
    Json identity;  ///< an object; what decides the bytes of the frames
    std::map<int, FrameRecord> frames;
    std::map<int, CheckpointRecord> checkpoints;  ///< by the frame whose state they hold
};

/// FNV-1a of the bytes as 16 hexadecimal digits.
std::string checksumOf(std::span<const std::uint8_t> bytes);

std::string encodeManifest(const Manifest& manifest);

/// Throws render::SystemError with the name for a text that is not a manifest.
Manifest decodeManifest(std::span<const std::uint8_t> text, const std::string& name);

/// What of two identities differs, as in "scene_hash: 12ab there, 34cd here"; empty where nothing does.
std::string differences(const Json& there, const Json& here);

}  // namespace tools
