// The main loop: simulate frame k+1, draw frame k, encode frame k-1, at the same time where there are threads for it.
// Called by `render` and `figures`.
#pragma once

#include <optional>
#include <string>

#include "render/opengl/context.h"
#include "render/picture/view.h"
#include "scenes/model/scene.h"
#include "tools/run/frame_folder.h"
#include "tools/run/run_report.h"
#include "tools/run/scene_options.h"
#include "tools/system/progress.h"

namespace tools {

struct RenderJob {
    const scenes::Scene* scene = nullptr;
    FrameRange frames;
    std::optional<FolderOptions> folder;  ///< that frames go to, with what is needed to go on; none: no frames
    std::string videoPath;                ///< empty: no video
    render::Quality quality = render::Quality::normal;
    render::Backend backend = render::Backend::osmesa;
    int threads = 1;
    Verbosity verbosity = Verbosity::normal;
    std::string title;  ///< in the progress
};

/// Draws the frames of a job. A simulation that becomes unstable ends the run after the frames before that moment, and
/// a signal, where there is a folder, after the frames in hand; the report has the reason. The outside world's failures
/// are thrown.
FinishedRun renderFrames(const RenderJob& job);

}  // namespace tools
