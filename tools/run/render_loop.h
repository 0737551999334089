// The render loop: simulates frame k + 1 or reads its state, draws frame k and encodes frame k - 1, at the same time if
// there are threads for it. Called by `render` and `figures`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/picture/view.h"
#include "render/picture_formats.h"
#include "scenes/model/scene.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/simulated_states.h"
#include "tools/run/options.h"
#include "tools/run/run_report.h"
#include "tools/system/progress.h"

namespace tools {

struct RenderJob : DrawJob {
    FrameList frames;
    std::optional<FolderOptions> folder;      ///< folder of frames and checkpoints; none: no frame becomes a file
    std::string videoPath;                    ///< path of the video, with its kind; empty: no video is made
    bool pipesFrames = false;                 ///< whether frames go to standard output, one file after the other
    bool estimatesErrors = true;              ///< whether the error of a fixed step is estimated at some of the frames
    const SimulatedStates* states = nullptr;  ///< where the particles of all frames come from; nullptr: a simulation
    /// What the files of a frame show, in the order of render::pictureFormats(). A video needs the first of these.
    std::vector<const render::PictureFormat*> formats = {render::pictureFormats().data()};
};

/// Draws the frames of a job. If the simulation becomes unstable, the run ends after the frames before that. After a
/// signal it ends when the frames in flight are written, if there is a folder to resume from. The report has the
/// reason.
/// @throws render::SystemError
FinishedRun renderFrames(const RenderJob& job);

}  // namespace tools
