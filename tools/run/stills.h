// Pictures of single moments of a scene, drawn in one simulation: stills, and the panels of strips. Called by `strip`
// and `figures`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/opengl/context.h"
#include "render/picture/image.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"
#include "tools/system/progress.h"

namespace tools {

/// How the pictures are made.
struct StillsJob {
    const scenes::Scene* scene = nullptr;
    render::Quality quality = render::Quality::final;
    render::Backend backend = render::Backend::osmesa;
    int threads = 1;
    Verbosity verbosity = Verbosity::normal;
    std::string title;  ///< in the progress
};

/// What is drawn in them: a still as the scene asks for it, a strip, or both.
struct StillSelection {
    std::optional<int> stillFrame;
    std::vector<int> stripFrames;  ///< ascending
};

struct StillPictures {
    render::Image still;    ///< empty if none was wanted
    render::Image strip;    ///< likewise
    std::string stateHash;  ///< of the last moment
};

/// Frames between the moments are simulated but not drawn. The panels of a strip have their time below them and no time
/// stamp; the color bar is on the last panel, the scale bar on the first, or on each if the camera moves.
/// Throws: engine::InstabilityError, render::SystemError.
StillPictures drawStills(const StillsJob& job, const StillSelection& moments);

}  // namespace tools
