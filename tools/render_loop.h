// The main loop: simulate frame k+1, draw frame k, encode frame k-1, at the same time where there are threads for it.
// Called by `render` and `figures`.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "render/context.h"
#include "render/view.h"
#include "scenes/scene.h"
#include "tools/progress.h"
#include "tools/run_report.h"
#include "tools/scene_options.h"

namespace tools {

struct RenderJob {
    const scenes::Scene* scene = nullptr;
    FrameRange frames;
    std::function<std::optional<std::string>(int)> pngPath;  ///< where a frame goes, if it is wanted as a file
    std::string videoPath;                                   ///< empty: no video
    render::Quality quality = render::Quality::normal;
    render::Backend backend = render::Backend::osmesa;
    int threads = 1;
    Talk talk = Talk::normal;
    std::string title;  ///< in the progress
};

/// Draws the frames of a job. A simulation that becomes unstable ends the run after the frames before that moment, with
/// the reason in the report; the outside world's failures are thrown.
FinishedRun renderFrames(const RenderJob& job);

}  // namespace tools
