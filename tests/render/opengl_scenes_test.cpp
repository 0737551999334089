// Built-in scenes drawn by both renderers, from scene file to pixels.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "render/compare/compare.h"
#include "scenes/build/read_scene.h"
#include "scenes/view/frame_view.h"
#include "tests/render/pictures.h"

using pictures::By;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{320, 180};
constexpr double kPixels = 320.0 * 180.0;

struct Case {
    std::string name;
    int frame = 0;
    std::vector<std::string> overrides = {};  ///< of scenes that take long to simulate; they show the same things
};

/// Scenes of every look of the library, and of balls of one size and of very different sizes.
std::vector<Case> cases() {
    return {{"cascade", 30},
            {"fountain", 20},
            {"jam", 5, {"physics.stepper=linearly-implicit", "physics.step=0.01"}},
            {"lava", 30},
            {"liquid", 5, {"physics.stepper=velocity-verlet", "physics.step=0.004"}},
            {"molten-metal", 30},
            {"powder", 30},
            {"solid", 6, {"physics.stepper=velocity-verlet", "physics.step=0.004"}},
            {"splash", 12},
            {"paper/figure-1", 100},
            {"hard/heavy", 2}};
}

scenes::Scene sceneOf(const Case& one, const std::string& style) {
    scenes::Overrides overrides(one.overrides.begin(), one.overrides.end());
    overrides.emplace_back("look.style=" + style);
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", kSize.width, kSize.height));
    return scenes::loadScene(fmt::format("{}/scenes/library/{}.toml", GLOBULAR_SOURCE, one.name), overrides);
}

}  // namespace

TEST_CASE("Both renderers draw the same picture of built-in scenes", "[opengl]") {
    for (const Case& one : cases()) {
        engine::Simulation simulation = engine::start(sceneOf(one, "spheres").setup);
        scenes::advanceToFrame(sceneOf(one, "spheres"), simulation, one.frame);
        for (const std::string style : {"spheres", "metaballs"}) {
            const render::View view = scenes::frameView(sceneOf(one, style), simulation);
            const render::Image byCpu = pictures::drawn(By::cpu, view, kSize, Quality::normal);
            const render::Image byOpenGl = pictures::drawn(By::openGl, view, kSize, Quality::normal);
            const auto difference = pictures::compare(byOpenGl, byCpu, 64);
            INFO(one.name << ", " << style << ": " << difference);
            if (style == "spheres") {
                CHECK(difference.largest <= 1);  // single precision, rounded to bytes
                continue;
            }
            render::CompareLimits limits = render::limitsOf("renderer");
            limits.largest = 255;
            const render::Comparison comparison = render::compare(byOpenGl, byCpu, limits);
            for (const std::string& reason : comparison.reasons) UNSCOPED_INFO(reason);
            CHECK(comparison.passed());
            // Pixels that silhouettes cross. The CPU casts rays only through the samples toward the other surface,
            // OpenGL through all, and in most pixels this is nearer to the exact picture. Counted in all scenes of the
            // library: up to 7 pixels.
            CHECK(difference.share <= 12.0 / kPixels);
        }
    }
}

#endif
