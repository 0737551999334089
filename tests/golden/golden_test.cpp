// A golden frame for each of the paper's figures: the whole way from scene file to pixels. On failure the actual
// picture, the expected one and their difference are left in the build folder; tests/golden/approve.sh makes the
// actuals the new goldens.
#include <filesystem>

#include "render/png.h"
#include "render/renderer.h"
#include "scenes/frame_steps.h"
#include "scenes/frame_view.h"
#include "tests/catch.h"
#include "tests/golden/golden_compare.h"
#include "tools/output_file.h"

namespace {

namespace fs = std::filesystem;

render::Image drawStill(const std::string& name) {
    const std::string path = std::string(GLOBULAR_SOURCE) + "/scenes/paper/" + name + ".toml";
    scenes::Scene scene = scenes::loadScene(path, {});
    // Half size: particles are still seven to ten pixels wide, and the goldens stay small.
    scene.size = {scene.size.width / 2, scene.size.height / 2};
    engine::Simulation simulation = engine::start(scene.setup);
    scenes::advanceToFrame(scene, simulation, scenes::stillFrame(scene));
    render::Context context(render::Backend::osmesa);
    render::Renderer renderer(context, scene.size, render::Quality::normal);
    return renderer.draw(scenes::frameView(scene, simulation));
}

void keep(const std::string& name, const render::Image& image) {
    tools::createFolder(GOLDEN_OUTPUT);
    tools::writeFile(fs::path(GOLDEN_OUTPUT) / name, render::encodePng(image));
}

void checkGolden(const std::string& name) {
    const render::Image actual = drawStill(name);
    keep(name + ".png", actual);
    const fs::path path = fs::path(GLOBULAR_SOURCE) / "tests" / "golden" / (name + ".png");
    INFO(path.string() << " against " << GOLDEN_OUTPUT << "/" << name << ".png; approve with tests/golden/approve.sh");
    REQUIRE(fs::exists(path));
    const render::Image expected = render::decodePng(tools::readFile(path), path.string());
    const std::string reasons = golden::verdict(golden::differenceOf(actual, expected));
    if (!reasons.empty()) {
        keep(name + "-expected.png", expected);
        keep(name + "-difference.png", golden::differenceImage(actual, expected));
    }
    CHECK(reasons == "");
}

}  // namespace

TEST_CASE("Figure 1 looks as it did", "[golden]") {
    checkGolden("figure-1");
}
TEST_CASE("Figure 2 looks as it did", "[golden]") {
    checkGolden("figure-2");
}
TEST_CASE("Figure 3 looks as it did", "[golden]") {
    checkGolden("figure-3");
}
TEST_CASE("Figure 4 looks as it did", "[golden]") {
    checkGolden("figure-4");
}

TEST_CASE("Known-bad pictures are noticed", "[golden]") {
    const fs::path path = fs::path(GLOBULAR_SOURCE) / "tests" / "golden" / "figure-2.png";
    const render::Image good = render::decodePng(tools::readFile(path), path.string());
    CHECK(golden::verdict(golden::differenceOf(good, good)) == "");

    render::Image onePixel = good;
    onePixel.rgb[3 * 1000 + 1] = static_cast<std::uint8_t>(onePixel.rgb[3 * 1000 + 1] ^ 0x40);
    CHECK(golden::verdict(golden::differenceOf(onePixel, good)) != "");

    render::Image shifted = good;
    std::copy(good.rgb.begin(), good.rgb.end() - 3, shifted.rgb.begin() + 3);
    CHECK(golden::verdict(golden::differenceOf(shifted, good)) != "");

    render::Image brighter = good;  // by one step everywhere: no pixel is noticeable, the mean is
    for (std::uint8_t& channel : brighter.rgb) channel = static_cast<std::uint8_t>(channel + (channel < 255 ? 1 : 0));
    CHECK(golden::verdict(golden::differenceOf(brighter, good)) != "");

    render::Image blank = good;
    std::fill(blank.rgb.begin(), blank.rgb.end(), std::uint8_t{0});
    CHECK(golden::verdict(golden::differenceOf(blank, good)) != "");

    render::Image rounding = good;  // the last bit of one channel in fifty
    for (std::size_t k = 0; k < rounding.rgb.size(); k += 50)
        rounding.rgb[k] = static_cast<std::uint8_t>(rounding.rgb[k] ^ 1);
    CHECK(golden::verdict(golden::differenceOf(rounding, good)) == "");

    CHECK_THROWS_AS(golden::differenceOf(render::Image{1, 1, {0, 0, 0}}, good), std::invalid_argument);
}
