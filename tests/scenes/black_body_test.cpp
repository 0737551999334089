// The light of black bodies against published numbers, and what particles colored by it look like.
#include "tests/catch.h"

#include "scenes/text/black_body.h"
#include "scenes/text/color.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

/// A point of 1200 K, gray by its material, colored by its temperature.
const std::string kHotPoint = scenes_test::kTop +
                              "[material]\ncolor = [0.3, 0.3, 0.4]\ncapacity = 500\nconductivity = 1\n"
                              "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\ntemperature = 1200\n"
                              "[look]\ncolor_by = \"temperature\"\ncolor_map = \"black-body\"\n";

}  // namespace

TEST_CASE("a black body has the published luminance and chromaticity") {
    // The candela was once defined by freezing platinum, 2042 K: 60 cd/cm^2.
    CHECK(scenes::blackBodyXyz(2042.0).y() == Approx(60e4).epsilon(0.01));
    struct Published {
        double temperature, x, y;
    };
    // Planckian locus of CIE 15; 2856 K is illuminant A. The fits to the matching functions are off by up to 0.0045.
    for (const Published& row : {Published{1500, 0.5857, 0.3931}, {2856, 0.4476, 0.4074}, {6500, 0.3135, 0.3237}}) {
        INFO(row.temperature);
        const Vec3 xyz = scenes::blackBodyXyz(row.temperature);
        CHECK(xyz.x() / xyz.sum() == Approx(row.x).margin(0.005));
        CHECK(xyz.y() / xyz.sum() == Approx(row.y).margin(0.005));
    }
    CHECK(scenes::blackBodyXyz(0.0) == Vec3(0.0, 0.0, 0.0));
}

TEST_CASE("squares of the ramp are light relative to that of the highest temperature") {
    const std::vector<Vec3> ramp = scenes::blackBodyRamp(700.0, 1500.0, 9);
    REQUIRE(ramp.size() == 9);
    CHECK(ramp.back().x() == 1.0);
    CHECK(ramp.back().z() == 0.0);  // red heat has no blue
    // In red light radiance grows by Wien's law as exp(-c / T), c = 0.01439 m K over 600 to 630 nm.
    const double ratio = ramp[4].cwiseAbs2().x();
    CHECK(ratio > std::exp(-0.01439 / 600e-9 * (1.0 / 1100.0 - 1.0 / 1500.0)));
    CHECK(ratio < std::exp(-0.01439 / 630e-9 * (1.0 / 1100.0 - 1.0 / 1500.0)));
    for (std::size_t k = 1; k < ramp.size(); ++k) CHECK(ramp[k].x() > ramp[k - 1].x());
}

TEST_CASE("the light of a hot particle adds to the color of its material") {
    const scenes::Scene scene = sceneOf(kHotPoint);
    const glm::vec3 color = scenes_test::viewAt(scene, 0.0).particles.at(0).color;
    const Vec3 light = scenes::rampColor(scenes::blackBodyRamp(800.0, 1500.0), 4.0 / 7.0);
    CHECK(color.x == Approx(std::hypot(0.3, light.x())).epsilon(1e-5));
    CHECK(color.z == Approx(0.4).epsilon(1e-5));
    const scenes::Scene cold = sceneOf(kHotPoint, {"body[0].temperature=300"});
    CHECK(scenes_test::viewAt(cold, 0.0).particles.at(0).color.x == Approx(0.3).epsilon(1e-5));
    CHECK(sceneOf(kHotPoint, {"look.color_range=[600, 1200]"}).look.ramp == scenes::blackBodyRamp(600.0, 1200.0));
}

TEST_CASE("the light of a black body is for temperatures that have some") {
    CHECK(problemsOf(kHotPoint, {"look.color_by=age"}).size() == 1);
    CHECK(problemsOf(kHotPoint + "color_range = [0, 200]\n") ==
          Lines{"pile.toml:14:15: color_range ends at 200 K, must reach 300 K for color_map \"black-body\""});
}
