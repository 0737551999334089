// One simulation runs through the selected frames in order of time.
#include "tools/run/stills.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "engine/run/diagnostics.h"
#include "render/overlay/panel_strip.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "scenes/view/frame_view.h"
#include "tools/run/open_renderer.h"
#include "tools/system/memory.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

/// Removes the parts of the overlay that a reader does not need on this panel.
void trimOverlay(const scenes::Scene& scene, const std::vector<int>& frames, int frame, render::Overlay& overlay) {
    overlay.stamp.clear();
    if (frame != frames.back()) overlay.colorBar.reset();
    if (frame != frames.front() && scene.camera.size() == 1) overlay.scaleBar.reset();
}

void advanceTo(const scenes::Scene& scene, int frame, engine::Simulation& simulation, Progress& progress) {
    const Progress::Work work(progress, fmt::format("frame {}", frame), simulation.time,
                              scenes::frameTime(scene, frame));
    scenes::advanceToFrame(scene, simulation, frame);
}

StillPictures drawAll(const DrawJob& job, const StillSelection& selection) {
    const scenes::Scene& scene = *job.scene;
    std::set<int> frames(selection.stripFrames.begin(), selection.stripFrames.end());
    if (selection.stillFrame) frames.insert(*selection.stillFrame);
    const OpenedRenderer opened = openRenderer(job);
    render::Renderer& renderer = *opened.renderer;
    const auto inMemory = [&](const auto& work) { return withMemoryForParticles(scene.setup.initial.count(), work); };
    engine::Simulation simulation = inMemory([&] { return engine::start(scene.setup); });
    Progress progress(job.title, static_cast<int>(frames.size()), job.verbosity);
    StillPictures pictures;
    std::vector<render::Panel> panels;
    simulation.beforeStep = [&](const engine::Simulation& stepping) { progress.stepBegins(stepping.time); };
    for (const int frame : frames) {
        inMemory([&] { advanceTo(scene, frame, simulation, progress); });
        const Progress::Work work(progress, fmt::format("drawing frame {}", frame));
        render::View view = scenes::frameView(scene, simulation);
        if (frame == selection.stillFrame) pictures.still = renderer.draw(view);
        if (std::binary_search(selection.stripFrames.begin(), selection.stripFrames.end(), frame)) {
            trimOverlay(scene, selection.stripFrames, frame, view.overlay);
            panels.push_back({renderer.draw(view), scenes::timeText(scene, simulation.time)});
        }
        progress.frameDone(frame, simulation.time);
    }
    if (!panels.empty()) pictures.strip = render::joinPanels(panels);
    pictures.stateHash = engine::stateHash(simulation.particles);
    return pictures;
}

/// @throws scenes::InputError if the strip is too large. A strip may have more pixels than a frame, because it is drawn
/// panel by panel, but all panels are in memory at once. The factor is chosen: far more panels than a page can show.
void requireStripSize(const scenes::Scene& scene, std::size_t panels) {
    const double most = 16.0 * scenes::Limits().pixels;
    const double pixels = static_cast<double>(panels) * scene.size.width * scene.size.height;
    if (pixels <= most) return;
    throw scenes::InputError(
        scene.sourceName,
        fmt::format("a strip of {} panels of {} x {} pixels is larger than the {:.0f} pixels that one may have", panels,
                    scene.size.width, scene.size.height, most));
}

}  // namespace

StillPictures drawStills(const DrawJob& job, const StillSelection& selection) {
    requireStripSize(*job.scene, selection.stripFrames.size());
    StillPictures pictures;
    const render::PictureSize size = job.scene->size;
    withMemoryForPictures(size.width, size.height,
                          [&] { onThreads(job.threads, [&] { pictures = drawAll(job, selection); }); });
    return pictures;
}

}  // namespace tools
