// Reads scene files. Every command, study and test that takes a scene starts here.
#pragma once

#include <string>
#include <string_view>

#include "scenes/model/scene.h"
#include "scenes/text/input_error.h"
#include "scenes/text/override.h"

namespace scenes {

/// The largest scene that is accepted, so that a mistyped number does not exhaust the memory or fill the disk. The
/// option --limit raises a limit. The defaults are chosen.
struct Limits {
    double particles = 2e6;         ///< most particles of bodies and emitters together; one takes about a kilobyte
    double frames = 1e5;            ///< most frames of the animation: an hour at 30 frames per second
    double pixels = 3840.0 * 2160;  ///< most pixels of a picture; at final quality one takes about 150 bytes
};

/// Reads a scene from TOML text.
/// @param fileName  name at the beginning of each message; files that the scene refers to are looked for in its folder
/// @throws InputError with all mistakes: those in the text by position, then those in the overrides in order
Scene readScene(std::string_view text, const std::string& fileName, const Overrides& overrides,
                const Limits& limits = {});

/// Reads a scene from a file.
/// @throws InputError with all mistakes of the scene, or if the file cannot be read
Scene loadScene(const std::string& path, const Overrides& overrides, const Limits& limits = {});

}  // namespace scenes
