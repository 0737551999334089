// All pictures have the same size, so that one renderer of each kind draws them all.
#include "tests/golden/draw_goldens.h"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <span>

#include "engine/run/diagnostics.h"
#include "render/opengl/context/device.h"
#include "render/output/png.h"
#include "scenes/build/read_scene.h"
#include "scenes/view/frame_view.h"
#include "tools/compare/picture_provenance.h"
#include "tools/frames/manifest.h"
#include "tools/run/open_renderer.h"
#include "tools/system/output_file.h"
#include "tools/system/processors.h"

namespace golden {
namespace {

namespace fs = std::filesystem;

constexpr render::PictureSize kSize = {320, 180};
constexpr std::array kStyles = {"spheres", "metaballs"};

scenes::Scene sceneIn(const GoldenScene& golden, const std::string& style) {
    scenes::Overrides overrides(golden.overrides.begin(), golden.overrides.end());
    overrides.emplace_back("resolution=1");  // coarse particles show the same things in a fraction of the time
    overrides.emplace_back("look.style=" + style);
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", kSize.width, kSize.height));
    return scenes::loadScene(fmt::format("{}/scenes/library/{}.toml", GLOBULAR_SOURCE, golden.name), overrides);
}

tools::OpenedRenderer open(bool isOpenGl) {
    return tools::openRenderer({isOpenGl, {}}, kSize, render::Quality::normal, tools::usableProcessors());
}

/// A scene at one of its times, in both styles.
struct Moment {
    const GoldenScene& golden;
    int frame;
    const std::array<scenes::Scene, 2>& scenes;
    const engine::Simulation& simulation;
};

/// Calls the function with each moment of a scene.
template <class Function>
void forMoments(const GoldenScene& golden, std::size_t timeCount, const Function& function) {
    const std::array scenes = {sceneIn(golden, kStyles[0]), sceneIn(golden, kStyles[1])};
    engine::Simulation simulation = engine::start(scenes[0].setup);
    const std::array frames = {golden.first, golden.second};
    for (const int frame : std::span(frames).first(timeCount)) {
        scenes::advanceToFrame(scenes[0], simulation, frame);
        function(Moment{golden, frame, scenes, simulation});
    }
}

/// Draws a moment in both styles.
void drawMoment(const Moment& moment, const tools::OpenedRenderer& opened, const fs::path& folder) {
    tools::PictureProvenance provenance;
    provenance.stateHash = engine::stateHash(moment.simulation.particles);
    provenance.version = GLOBULAR_VERSION;
    provenance.renderer = opened.record;
    provenance.quality = "normal";
    for (std::size_t k = 0; k < kStyles.size(); ++k) {
        const fs::path path = folder / goldenName(moment.golden, kStyles[k], moment.frame, opened.record.name);
        const render::View view = scenes::frameView(moment.scenes[k], moment.simulation);
        const auto png = render::encodePng(opened.renderer->draw(view));
        provenance.sceneHash = moment.scenes[k].sceneHash;
        tools::createFolder(path.parent_path());
        tools::writeFile(path, png);
        tools::writeFile(tools::sidecarPath(path), tools::indentedText(tools::sidecarJson(
                                                       provenance, tools::checksumOf(png), kSize.width, kSize.height)));
    }
}

}  // namespace

bool canDrawWithOpenGl() {
    return render::isInBuild(render::Backend::osmesa);
}

void draw(const std::vector<GoldenScene>& scenes, std::size_t timeCount, const fs::path& folder) {
    const tools::OpenedRenderer cpu = open(false);
    const std::unique_ptr<const tools::OpenedRenderer> openGl(
        canDrawWithOpenGl() && timeCount > 1 ? new tools::OpenedRenderer(open(true)) : nullptr);
    for (const GoldenScene& scene : scenes)
        forMoments(scene, timeCount, [&](const Moment& moment) {
            drawMoment(moment, cpu, folder);
            if (openGl && scene.isDrawnWithOpenGl && moment.frame == scene.second) drawMoment(moment, *openGl, folder);
        });
}

}  // namespace golden
