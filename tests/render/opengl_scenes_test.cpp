// Built-in scenes drawn by both renderers, from scene file to pixels.
#include "tests/catch.h"

#ifdef RENDER_HAS_OPENGL

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "render/compare/compare.h"
#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "scenes/view/frame_view.h"
#include "tests/render/pictures.h"

using pictures::By;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{320, 180};
constexpr double kPixels = 320.0 * 180.0;

/// The picture of a scene that is compared.
struct Moment {
    int frame = 0;
    std::vector<std::string> overrides = {};  ///< of scenes that take long to simulate; they show the same things
};

/// Early frames, which are soon simulated, but late enough for the bodies to have met.
Moment momentOf(const std::string& scene) {
    static const std::map<std::string, Moment> moments{
        {"cascade", {30}},
        {"conveyor", {10}},
        {"fountain", {20}},
        {"gate", {20, {"physics.stepper=velocity-verlet", "physics.step=0.003"}}},
        {"honey", {20}},
        {"hourglass", {5}},
        {"jam", {5, {"physics.stepper=linearly-implicit", "physics.step=0.01"}}},
        {"lava", {30}},
        {"liquid", {5, {"physics.stepper=velocity-verlet", "physics.step=0.004"}}},
        {"mixer", {5}},
        {"molten-metal", {30}},
        {"mud", {20}},
        {"oil", {20}},
        {"powder", {30}},
        {"sand", {10}},
        {"solid", {6, {"physics.stepper=velocity-verlet", "physics.step=0.004"}}},
        {"splash", {12}},
        {"stamp", {5, {"physics.error=2"}}},
        {"sticky", {8}},
        {"wine", {25}},
        {"word", {15}}};
    if (const auto found = moments.find(scene); found != moments.end()) return found->second;
    return {scene.starts_with("hard/") ? 1 : 60};
}

scenes::Scene sceneOf(const scenes::LibraryEntry& entry, const std::string& style) {
    const std::vector<std::string> added = momentOf(entry.name).overrides;
    scenes::Overrides overrides(added.begin(), added.end());
    overrides.emplace_back("resolution=1");  // coarse particles show the same things in a fraction of the time
    overrides.emplace_back("look.style=" + style);
    overrides.emplace_back(fmt::format("look.size=[{}, {}]", kSize.width, kSize.height));
    return scenes::loadScene(entry.path, overrides);
}

bool isSeenThrough(const render::View& view) {
    const auto isTransparent = [](const render::MeshObstacle& mesh) { return mesh.medium.isTransparent(); };
    return view.surface.medium.isTransparent() || std::ranges::any_of(view.meshObstacles, isTransparent);
}

}  // namespace

TEST_CASE("Both renderers draw the same picture of every built-in scene", "[opengl][long]") {
    for (const scenes::LibraryEntry& entry : scenes::listScenes(GLOBULAR_SOURCE "/scenes/library")) {
        if (entry.name.starts_with("measured/")) continue;  // earlier versions of other scenes
        const scenes::Scene scene = sceneOf(entry, "spheres");
        engine::Simulation simulation = engine::start(scene.setup);
        scenes::advanceToFrame(scene, simulation, momentOf(entry.name).frame);
        for (const std::string style : {"spheres", "metaballs"}) {
            const render::View view = scenes::frameView(sceneOf(entry, style), simulation);
            const render::Image byCpu = pictures::drawn(By::cpu, view, kSize, Quality::normal);
            const render::Image byOpenGl = pictures::drawn(By::openGl, view, kSize, Quality::normal);
            const bool hasMesh = !view.meshObstacles.empty();
            const auto difference = pictures::compare(byOpenGl, byCpu, style != "spheres" ? 64 : hasMesh ? 24 : 1);
            INFO(entry.name << ", " << style << ": " << difference);
            if (isSeenThrough(view)) {
                // Behind bends neighboring rays go to places far apart, and roundings decide which: as in
                // transparency_test.cpp (measured here: share 0.0041, mean 0.42 where water fills half of the picture).
                CHECK(difference.share < 0.005);
                CHECK(difference.mean < 0.6);
                continue;
            }
            if (style == "spheres" && hasMesh) {
                // Samples of one pixel that see one smooth mesh are shaded together by the CPU and one by one by
                // OpenGL, which differ where the mesh bends within the pixel, as along the rim of a bowl.
                CHECK(difference.share <= 3.0 / kPixels);
                CHECK(difference.mean < 0.2);
                continue;
            }
            if (style == "spheres") {
                // Single precision, rounded to bytes. One of a pixel's four samples may lie so close to an outline that
                // roundings decide which sphere it hits: in one pixel of all scenes.
                CHECK(difference.largest <= 64);
                CHECK(difference.share <= 3.0 / kPixels);
                continue;
            }
            render::CompareLimits limits = render::limitsOf("renderer");
            limits.largest = 255;
            const render::Comparison comparison = render::compare(byOpenGl, byCpu, limits);
            for (const std::string& reason : comparison.reasons) UNSCOPED_INFO(reason);
            CHECK(comparison.passed());
            // Pixels that silhouettes cross. The CPU casts rays only through the samples toward the other surface,
            // OpenGL through all, and in most pixels this is nearer to the exact picture. Counted in all scenes of the
            // library: up to 7 pixels, and 29 in splash, where the pool meets the ground along a line of 150 pixels.
            CHECK(difference.share <= (entry.name == "splash" ? 44.0 : 12.0) / kPixels);
        }
    }
}

#endif
