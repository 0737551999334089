// The formats of particle files that `globular simulate --format` writes, beside that of the metaballs' field. A body
// with shape = "file" reads any of them (particle_file.h).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scenes/particles/particle_frame.h"

namespace scenes {

/// A format that the particles of a frame are written in.
struct ParticleFormat {
    std::string_view name;       ///< as --format names it
    std::string_view prefix;     ///< of the names of its files; the frame number and the extension follow
    std::string_view extension;  ///< with the dot; no two formats share both prefix and extension
    std::string_view help;       ///< what it is, in a few words
    std::string (*encode)(const ParticleFrame& frame);
};

/// All formats, the default one first.
std::span<const ParticleFormat> particleFormats();

}  // namespace scenes
