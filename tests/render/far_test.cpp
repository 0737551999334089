// A scene looks the same wherever it lies: positions reach the renderer relative to a point near the camera's target.
#include "tests/catch.h"

#include <fmt/format.h>

#include <string>

#include "scenes/build/read_scene.h"
#include "scenes/view/frame_view.h"
#include "tests/render/pictures.h"

namespace {

constexpr render::PictureSize kSize{160, 90};

std::string vec(const engine::Vec3& v) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

/// A ball above the ground between a sphere, a box and a container, everything moved by an offset.
std::string movedScene(const engine::Vec3& offset, const std::string& look) {
    const auto at = [&](double x, double y, double z) { return vec(offset + engine::Vec3(x, y, z)); };
    std::string text = "title = \"t\"\nduration = 1\n[[body]]\nshape = \"ball\"\nradius = 0.7\njitter = 0\n";
    text += fmt::format("center = {}\n", at(0.0, 1.0, 0.0));
    text += fmt::format("[[obstacle]]\nshape = \"sphere\"\nradius = 0.5\ncenter = {}\n", at(-1.5, 0.5, 0.5));
    text += fmt::format("[[obstacle]]\nshape = \"box\"\nminimum = {}\nmaximum = {}\n", at(1.0, 0.1, -0.5),
                        at(1.7, 0.6, 0.5));
    text += fmt::format("[[obstacle]]\nshape = \"container\"\nminimum = {}\nmaximum = {}\n", at(-2.5, 0.1, -2.0),
                        at(2.5, 3.0, 2.0));
    text += fmt::format("[camera]\neye = {}\ntarget = {}\n", at(2.0, 3.0, 6.0), at(0.0, 0.9, 0.0));
    return text + fmt::format("[look]\nground = true\nground_height = {:.17g}\nshadow_softness = 0.5\n", offset.y()) +
           look;
}

render::View viewOf(const std::string& text) {
    const scenes::Scene scene = scenes::readScene(text, "far.toml", {});
    return scenes::frameView(scene, engine::start(scene.setup));
}

}  // namespace

TEST_CASE("a scene looks the same far from the origin") {
    const pictures::By by = GENERATE(from_range(pictures::renderers()));
    CAPTURE(by);
    const auto renderer = makeRenderer(by, kSize, render::Quality::normal);
    for (const std::string style : {"spheres", "metaballs"}) {
        const std::string look = fmt::format("style = \"{}\"\n", style);
        const render::Image expected = renderer->draw(viewOf(movedScene({0.0, 0.0, 0.0}, look)));
        for (const double distance : {1e3, 1e5, 1e6, 9e7}) {
            const engine::Vec3 offset(distance, -0.3 * distance, 0.7 * distance);
            const auto found = pictures::compare(renderer->draw(viewOf(movedScene(offset, look))), expected, 2);
            INFO(style << ", " << distance << " m from the origin: " << found);
            // Of spheres only the rounding differs. The texels of the metaballs' depth map lie elsewhere in the scene,
            // which shows at the edges of shadows: 1.5 times what was measured at all four distances alike.
            CHECK(found.largest <= (style == "spheres" ? 1 : 26));
            CHECK(found.share <= (style == "spheres" ? 0.0 : 0.002));
        }
    }
}

// These offsets are multiples of the distances by which the origin of the view moves, and round nothing.
TEST_CASE("a scene moved by a power of two far away gives the same bytes") {
    const pictures::By by = GENERATE(from_range(pictures::renderers()));
    CAPTURE(by);
    const auto renderer = makeRenderer(by, kSize, render::Quality::normal);
    for (const std::string style : {"spheres", "metaballs"}) {
        const std::string look = fmt::format("style = \"{}\"\nocclusion = 0.8\n", style);
        const render::Image expected = renderer->draw(viewOf(movedScene({0.0, 0.0, 0.0}, look)));
        for (const double distance : {1048576.0, 67108864.0}) {
            const render::Image image = renderer->draw(viewOf(movedScene({distance, 0.0, -distance}, look)));
            INFO(style << ", " << distance << " m from the origin: " << pictures::compare(image, expected, 0));
            // A double rounds a position at 2^26 m by 2^-27 m, which a float shows in positions below 1/8 m only.
            CHECK(pictures::compare(image, expected, 0).largest <= (distance < 1e7 ? 0 : 1));
        }
    }
}
