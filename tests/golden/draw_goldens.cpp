// All pictures have the same size, so that one renderer draws them all.
#include "tests/golden/draw_goldens.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "engine/run/diagnostics.h"
#include "render/output/png.h"
#include "render/renderer.h"
#include "scenes/build/read_scene.h"
#include "scenes/view/frame_view.h"
#include "tools/compare/picture_provenance.h"
#include "tools/run/manifest.h"
#include "tools/run/options.h"
#include "tools/system/output_file.h"

namespace golden {
namespace {

namespace fs = std::filesystem;

constexpr render::PictureSize kSize = {320, 180};
constexpr std::array kStyles = {"spheres", "metaballs"};

scenes::Scene sceneIn(const GoldenScene& golden, const std::string& style) {
    scenes::Overrides overrides(golden.overrides.begin(), golden.overrides.end());
    overrides.emplace_back("look.style=" + style);
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", kSize.width, kSize.height));
    return scenes::loadScene(fmt::format("{}/scenes/library/{}.toml", GLOBULAR_SOURCE, golden.name), overrides);
}

class GoldenRenderer {
 public:
    explicit GoldenRenderer(const fs::path& folder) : folder_(folder), renderer_(kSize, render::Quality::normal) {}

    void draw(const GoldenScene& golden, std::size_t timeCount) {
        const std::array scenes = {sceneIn(golden, kStyles[0]), sceneIn(golden, kStyles[1])};
        engine::Simulation simulation = engine::start(scenes[0].setup);
        const std::array frames = {golden.first, golden.second};
        for (const int frame : std::span(frames).first(timeCount)) {
            scenes::advanceToFrame(scenes[0], simulation, frame);
            for (std::size_t k = 0; k < kStyles.size(); ++k) {
                const fs::path folder = folder_ / golden.name / kStyles[k];
                write(folder / fmt::format("frame-{:05}.png", frame), scenes[k], simulation);
            }
        }
    }

 private:
    void write(const fs::path& path, const scenes::Scene& scene, const engine::Simulation& simulation) {
        const auto png = render::encodePng(renderer_.draw(scenes::frameView(scene, simulation)));
        tools::PictureProvenance provenance;
        provenance.sceneHash = scene.sceneHash;
        provenance.stateHash = engine::stateHash(simulation.particles);
        provenance.version = GLOBULAR_VERSION;
        provenance.renderer.name = tools::kRendererNames[0];
        provenance.quality = "normal";
        tools::createFolder(path.parent_path());
        tools::writeFile(path, png);
        tools::writeFile(tools::sidecarPath(path), tools::indentedText(tools::sidecarJson(
                                                       provenance, tools::checksumOf(png), kSize.width, kSize.height)));
    }

    fs::path folder_;
    render::Renderer renderer_;
};

}  // namespace

void draw(const std::vector<GoldenScene>& scenes, std::size_t timeCount, const fs::path& folder) {
    GoldenRenderer renderer(folder);
    for (const GoldenScene& scene : scenes) renderer.draw(scene, timeCount);
}

}  // namespace golden
