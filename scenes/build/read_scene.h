// Reads scene files. Every command, study and test that takes a scene starts here.
#pragma once

#include <string>
#include <string_view>

#include "scenes/model/scene.h"
#include "scenes/text/input_error.h"
#include "scenes/text/override.h"

namespace scenes {

/// The largest scene that is accepted, so that a mistyped number does not exhaust the memory or fill the disk. The
/// command line raises a limit with --limit. The defaults are chosen.
struct Limits {
    double particles = 2e6;         ///< of bodies and emitters together; a particle takes about a kilobyte
    double frames = 1e5;            ///< an hour at 30 frames per second
    double pixels = 3840.0 * 2160;  ///< of a picture; at final quality a pixel takes about 150 bytes
};

/// Reads a scene from TOML text. Files that it refers to are looked for in the folder of fileName.
/// @param fileName  opens the message of each problem
/// @throws InputError with all mistakes: those of the text by position, then those of the overrides in order
Scene readScene(std::string_view text, const std::string& fileName, const Overrides& overrides,
                const Limits& limits = {});

/// Reads a scene from a file.
/// @throws InputError as readScene does, and also if the file cannot be read
Scene loadScene(const std::string& path, const Overrides& overrides, const Limits& limits = {});

}  // namespace scenes
