// Tests that the color maps are perceptually uniform, by CIELAB and CIEDE2000. The maps are made in OKLab, so that the
// test shares nothing with them.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/text/color.h"
#include "scenes/view/frame_view.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes::colorMap;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

/// CIELAB of linear sRGB, white point D65, by CIE 15 with the matrix of IEC 61966-2-1.
Vec3 labOf(const Vec3& linear) {
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
    const double x = f(linear.dot(Vec3(0.4124564, 0.3575761, 0.1804375)) / 0.95047);
    const double y = f(linear.dot(Vec3(0.2126729, 0.7151522, 0.0721750)));
    const double z = f(linear.dot(Vec3(0.0193339, 0.1191920, 0.9503041)) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double degrees(double radians) {
    return radians * 180.0 / std::numbers::pi;
}
double cosine(double degree) {
    return std::cos(degree * std::numbers::pi / 180.0);
}

/// The term (C^7 / (C^7 + 25^7))^(1/2) of CIEDE2000, which occurs twice in it.
double chromaWeight(double chroma) {
    return std::sqrt(std::pow(chroma, 7) / (std::pow(chroma, 7) + std::pow(25.0, 7)));
}

/// The color difference CIEDE2000 by Sharma, Wu and Dalal 2005, equations 2 to 22.
double difference(const Vec3& one, const Vec3& other) {
    const auto chroma = [](double a, double b) { return std::sqrt(a * a + b * b); };
    const double stretch =
        1.0 + 0.5 * (1.0 - chromaWeight(0.5 * (chroma(one.y(), one.z()) + chroma(other.y(), other.z()))));
    const double c1 = chroma(stretch * one.y(), one.z());
    const double c2 = chroma(stretch * other.y(), other.z());
    const auto hue = [&](const Vec3& lab) {
        const double angle = degrees(std::atan2(lab.z(), stretch * lab.y()));
        return angle < 0.0 ? angle + 360.0 : angle;
    };
    const double h1 = hue(one);
    const double h2 = hue(other);
    double turn = c1 * c2 == 0.0 ? 0.0 : h2 - h1;
    if (turn > 180.0) turn -= 360.0;
    if (turn < -180.0) turn += 360.0;
    double meanHue = h1 + h2;
    if (c1 * c2 != 0.0) {
        meanHue *= 0.5;
        if (std::abs(h1 - h2) > 180.0) meanHue += h1 + h2 < 360.0 ? 180.0 : -180.0;
    }
    const double meanChroma = 0.5 * (c1 + c2);
    const double fromGray = std::pow(0.5 * (one.x() + other.x()) - 50.0, 2);
    const double t = 1.0 - 0.17 * cosine(meanHue - 30.0) + 0.24 * cosine(2.0 * meanHue) +
                     0.32 * cosine(3.0 * meanHue + 6.0) - 0.20 * cosine(4.0 * meanHue - 63.0);
    const double l = (other.x() - one.x()) / (1.0 + 0.015 * fromGray / std::sqrt(20.0 + fromGray));
    const double c = (c2 - c1) / (1.0 + 0.045 * meanChroma);
    const double h = 2.0 * std::sqrt(c1 * c2) * cosine(0.5 * turn - 90.0) / (1.0 + 0.015 * meanChroma * t);
    const double blue = 30.0 * std::exp(-std::pow((meanHue - 275.0) / 25.0, 2));
    const double rotation = -cosine(2.0 * blue - 90.0) * 2.0 * chromaWeight(meanChroma);
    return std::sqrt(l * l + c * c + h * h + rotation * c * h);
}

/// The smallest and the largest of some numbers, relative to their mean.
struct Evenness {
    double least = 0.0;
    double most = 0.0;
};

Evenness evennessOf(const std::vector<double>& steps) {
    double sum = 0.0;
    for (const double step : steps) sum += step;
    const double mean = sum / static_cast<double>(steps.size());
    return {*std::min_element(steps.begin(), steps.end()) / mean, *std::max_element(steps.begin(), steps.end()) / mean};
}

struct Steps {
    std::vector<double> lightness;
    std::vector<double> difference;
};

Steps stepsOf(const std::vector<Vec3>& colors) {
    Steps steps;
    for (std::size_t k = 1; k < colors.size(); ++k) {
        const Vec3 before = labOf(colors[k - 1]);
        const Vec3 here = labOf(colors[k]);
        steps.lightness.push_back(here.x() - before.x());
        steps.difference.push_back(difference(before, here));
    }
    return steps;
}

/// Whether a map counts as uniform: by CIELAB no step of lightness differs from the mean by more than 15 %, and by
/// CIEDE2000 every step is between two thirds and one and a half of the mean. Chosen; the rainbow below is far outside.
bool isUniform(const std::vector<Vec3>& colors) {
    const Steps steps = stepsOf(colors);
    const Evenness lightness = evennessOf(steps.lightness);
    const Evenness seen = evennessOf(steps.difference);
    return lightness.least > 0.85 && lightness.most < 1.15 && seen.least > 2.0 / 3.0 && seen.most < 1.5;
}

}  // namespace

TEST_CASE("CIEDE2000 gives the published differences") {
    // Pairs 1, 7 and 25 of Sharma's table 1, which has four decimals.
    CHECK(difference({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}) == Approx(2.0425).margin(5e-5));
    CHECK(difference({50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}) == Approx(2.3669).margin(5e-5));
    CHECK(difference({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}) == Approx(1.2644).margin(5e-5));
    CHECK(labOf(Vec3(1.0, 1.0, 1.0)).x() == Approx(100.0).margin(1e-4));  // the digits of the matrix
    CHECK(std::abs(labOf(Vec3(1.0, 1.0, 1.0)).y()) < 0.01);
}

TEST_CASE("a rainbow and a ramp in linear light do not count as uniform") {
    std::vector<Vec3> rainbow;
    std::vector<Vec3> ramp;
    for (int k = 0; k < 65; ++k) {
        const double t = k / 64.0;
        const auto tent = [&](double middle) { return std::clamp(1.5 - std::abs(4.0 * t - middle), 0.0, 1.0); };
        rainbow.emplace_back(tent(3.0), tent(2.0), tent(1.0));
        ramp.push_back(scenes::rampColor({Vec3(0.0, 0.0, 0.2), Vec3(1.0, 1.0, 1.0)}, t));
    }
    CHECK(!isUniform(rainbow));
    CHECK(!isUniform(ramp));
}

TEST_CASE("in every map lightness increases and all steps look equal") {
    REQUIRE(scenes::colorMapNames().size() == 4);
    for (const std::string_view name : scenes::colorMapNames()) {
        for (const int count : {9, 65, 256}) {
            INFO(name << ", " << count << " colors");
            const std::vector<Vec3> colors = colorMap(name, count);
            REQUIRE(colors.size() == static_cast<std::size_t>(count));
            const Steps steps = stepsOf(colors);
            const Evenness lightness = evennessOf(steps.lightness);
            const Evenness seen = evennessOf(steps.difference);
            INFO("lightness " << lightness.least << " to " << lightness.most << ", differences " << seen.least << " to "
                              << seen.most);
            CHECK(*std::min_element(steps.lightness.begin(), steps.lightness.end()) > 0.0);
            CHECK(isUniform(colors));
        }
    }
}

TEST_CASE("every color of a map is inside the sRGB gamut, and the maps differ") {
    for (const std::string_view name : scenes::colorMapNames()) {
        INFO(name);
        const std::vector<Vec3> colors = colorMap(name);
        for (const Vec3& color : colors) {
            CHECK(color.minCoeff() >= 0.0);
            CHECK(color.maxCoeff() <= 1.0);
        }
        CHECK(labOf(colors.front()).x() < 20.0);
        CHECK(labOf(colors.back()).x() > 85.0);
        for (const std::string_view other : scenes::colorMapNames())
            if (other != name) CHECK(difference(labOf(colors[128]), labOf(colorMap(other)[128])) > 5.0);
    }
    CHECK_THROWS_AS(colorMap("viridis"), std::logic_error);
}

TEST_CASE("a scene refers to a map by name, and particles have its colors") {
    const std::string point = scenes_test::kTop +
                              "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\nvelocity = [3, 0, 4]\n"
                              "[look]\ncolor_by = \"speed\"\ncolor_range = [0, 10]\ncolor_map = \"ember\"\n";
    const scenes::Scene scene = sceneOf(point);
    CHECK(scene.look.ramp == colorMap("ember"));
    const glm::vec3 color = scenes_test::viewAt(scene, 0.0).particles.at(0).color;
    const Vec3 middle = colorMap("ember", 3)[1];  // for a speed of 5 m/s, in the middle of the range
    for (int channel = 0; channel < 3; ++channel)
        CHECK(color[channel] == Approx(middle[channel]).margin(1e-4));  // between two of 256 colors
    CHECK(sceneOf(point, {"look.color_map=dusk"}).look.ramp == colorMap("dusk"));
    CHECK(sceneOf(point, {"look.color_map=dusk", "overlay.color_bar=true"}).look.common.overlay.colorBar);
}

TEST_CASE("a color map and explicit colors exclude each other, and unknown names are rejected") {
    const std::string look = kBall + "[look]\ncolor_by = \"speed\"\n";
    CHECK(problemsOf(look + "colors = [\"#000000\"]\ncolor_map = \"ember\"\n") ==
          Lines{"pile.toml:9:13: colors and color_map exclude each other, give one"});
    // An override takes precedence over the file.
    CHECK(sceneOf(look + "colors = [\"#000000\"]\n", {"look.color_map=ember"}).look.ramp == colorMap("ember"));
    CHECK(sceneOf(look + "color_map = \"ember\"\n", {"look.colors=[\"#000000\"]"}).look.ramp.size() == 1);
    CHECK(problemsOf(look, {"look.colors=[\"#000000\"]", "look.color_map=ember"}).size() == 1);
    CHECK(problemsOf(look + "color_map = \"embers\"\n") ==
          Lines{"pile.toml:8:13: color_map is \"embers\", must be \"lagoon\", \"ember\", \"dusk\", \"glacier\" or "
                "\"black-body\", did you mean \"ember\"?"});
    CHECK(problemsOf(kBall + "[look]\ncolor_map = \"ember\"\n") ==
          Lines{"pile.toml:7:1: color_map does not apply to color_by \"material\", only to speed, age, temperature"});
}
