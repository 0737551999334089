// Triangle meshes as obstacles: what is seen of them, their shadows, and what stands before and behind them.
#include "tests/catch.h"

#include <cstdlib>
#include <fstream>
#include <vector>

#include "render/output/png.h"
#include "tests/render/solid_meshes.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

/// Writes a picture to the folder in the environment variable GLOBULAR_TEST_PICTURES, to be looked at.
void show(const char* name, const render::Image& image) {
    const char* folder = std::getenv("GLOBULAR_TEST_PICTURES");
    if (folder == nullptr) return;
    const std::vector<std::uint8_t> bytes = render::encodePng(image);
    std::ofstream(std::string(folder) + '/' + name + ".png", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

TEST_CASE("Meshes among particles are drawn as by the oracle", "[meshes]") {
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        for (const auto style : {render::Style::spheres, render::Style::metaballs}) {
            render::View view = cloudWithMeshes(60);
            view.style = style;
            view.camera.projection = projection;
            view.camera.halfHeight = 2.0F;
            const Difference difference = differenceFromOracle(By::cpu, view, kSize, 1);
            INFO("projection " << int(projection) << ", style " << int(style) << ": " << difference);
            // Pixels on outlines, where single precision may decide otherwise; metaballs are cast at every second
            // pixel.
            CHECK(difference.share <= (style == render::Style::spheres ? 6.0 : 40.0) / kPixels);
        }
    }
}

TEST_CASE("Samples at outlines of meshes are averaged as by the oracle", "[meshes]") {
    render::View view = cloudWithMeshes(60);
    for (const Quality quality : {Quality::normal, Quality::final}) {
        const Difference difference = compare(drawn(view, kSize, quality), fromOracle(view, kSize, 6), 16);
        INFO("quality " << int(quality) << ": " << difference);
        // In normal quality four samples stand for 36. Chosen: the same limits hold for spheres and boxes.
        CHECK(difference.mean < (quality == Quality::normal ? 1.2 : 0.7));
        CHECK(difference.share < (quality == Quality::normal ? 0.06 : 0.02));
    }
}

TEST_CASE("The shadows of meshes are the oracle's", "[meshes]") {
    for (const float softness : {0.0F, 0.3F, 1.0F}) {
        render::View view = cloudWithMeshes(60);
        view.light.shadows = true;
        view.light.softness = softness;
        view.ambient.occlusion = 0.7F;
        const Difference difference = compare(drawn(view, kSize, Quality::draft), fromOracle(view, kSize, 2), 24);
        show(softness > 0.5F ? "soft" : softness > 0.0F ? "less" : "hard", drawn(view, {1280, 720}, Quality::normal));
        show(softness > 0.5F   ? "soft-oracle"
             : softness > 0.0F ? "less-oracle"
                               : "hard-oracle",
             fromOracle(view, {320, 180}, 1));
        INFO("softness " << softness << ": " << difference);
        CHECK(difference.share < 0.06);
        CHECK(difference.mean < 1.5);
    }
}
