// Pictures with known defects against every profile: the verdict of each, and the rule that decided.
#include "render/compare/compare.h"

#include <stdexcept>
#include <string>

#include "tests/catch.h"
#include "tests/render/test_pictures.h"

using render::Image;
using namespace test_pictures;

namespace {

std::string ruleOf(const Image& actual, const Image& expected, const char* profile) {
    const render::Comparison comparison = render::compare(actual, expected, render::limitsOf(profile));
    const bool passes =
        comparison.rule == render::CompareRule::identical || comparison.rule == render::CompareRule::withinLimits;
    CHECK(comparison.passed() == passes);
    return render::nameOf(comparison.rule);
}

/// The deciding rules for the profiles strict, vendor, renderer and loose.
using Verdicts = std::vector<std::string>;

Verdicts verdicts(const Image& actual, const Image& expected) {
    return {ruleOf(actual, expected, "strict"), ruleOf(actual, expected, "vendor"),
            ruleOf(actual, expected, "renderer"), ruleOf(actual, expected, "loose")};
}

}  // namespace

TEST_CASE("Each profile's verdict on pictures with known defects", "[compare]") {
    const Image good = balls();
    CHECK(verdicts(good, good) == Verdicts{"identical", "identical", "identical", "identical"});
    CHECK(verdicts(onePixel(good, 30, 40, 60), good) ==
          Verdicts{"largest", "largest", "within-limits", "within-limits"});
    CHECK(verdicts(onePixel(good, 30, 40, 16), good) ==
          Verdicts{"largest", "within-limits", "within-limits", "within-limits"});
    CHECK(verdicts(onePixel(good, 30, 40, 65), good) == Verdicts{"largest", "largest", "largest", "largest"});
    CHECK(verdicts(shifted(good), good) == Verdicts{"largest", "largest", "largest", "largest"});
    CHECK(verdicts(darker(good, 0.98), good) == Verdicts{"largest", "share", "mean", "within-limits"});
    CHECK(verdicts(darker(good, 0.9), good) == Verdicts{"largest", "largest", "share", "share"});
    CHECK(verdicts(gray(good), good) == Verdicts{"largest", "largest", "largest", "largest"});
    CHECK(verdicts(blank(good), good) == Verdicts{"largest", "largest", "largest", "largest"});
    CHECK(verdicts(noisy(good, 1), good) == Verdicts{"largest", "mean", "mean", "within-limits"});
    CHECK(verdicts(noisy(good, 16), good) == Verdicts{"largest", "share", "share", "mean"});
}

TEST_CASE("The gray picture is as light as the colored one, and a shift breaks several limits", "[compare]") {
    // Without these properties the verdicts above would prove little.
    const Image good = balls();
    const render::Comparison shift = render::compare(shifted(good), good, render::limitsOf("loose"));
    CHECK(shift.reasons.size() >= 2);  // not only the largest difference
    double light = 0.0, grayLight = 0.0;
    const Image other = gray(good);
    for (std::size_t k = 0; k < good.rgb.size(); k += 3) {
        light += 0.2126 * good.rgb[k] + 0.7152 * good.rgb[k + 1] + 0.0722 * good.rgb[k + 2];
        grayLight += other.rgb[k];
    }
    CHECK(grayLight / light == Approx(1.0).epsilon(0.5 / 50.0));  // half a step of rounding, on grays of at least 50
}

TEST_CASE("Every limit decides alone", "[compare]") {
    const Image good = balls();
    render::CompareLimits wide{.threshold = 0, .share = 1.0, .largest = 255, .mean = 255.0, .ssim = -1.0};
    const Image bad = noisy(good, 10);
    const auto rule = [&](const render::CompareLimits& limits) {
        const render::Comparison comparison = render::compare(bad, good, limits);
        CHECK(comparison.reasons.size() == (comparison.rule == render::CompareRule::withinLimits ? 0 : 1));
        return std::string(render::nameOf(comparison.rule));
    };
    CHECK(rule(wide) == "within-limits");
    render::CompareLimits limits = wide;
    limits.largest = 9;
    CHECK(rule(limits) == "largest");
    limits = wide;
    limits.share = 0.5;
    CHECK(rule(limits) == "share");
    limits = wide;
    limits.mean = 1.0;
    CHECK(rule(limits) == "mean");
    limits = wide;
    limits.ssim = 0.999;
    CHECK(rule(limits) == "ssim");
}

TEST_CASE("The worst pixels come first, with their values", "[compare]") {
    const Image good = balls();
    Image bad = onePixel(onePixel(good, 5, 7, 20), 100, 60, 50);
    const auto comparison = render::compare(bad, good, render::limitsOf("vendor"));
    REQUIRE(comparison.metrics.worst.size() == 2);
    const render::PixelDifference& worst = comparison.metrics.worst.front();
    CHECK(worst.x == 100);
    CHECK(worst.y == 60);
    CHECK(worst.largest == 50);
    CHECK(worst.actual[1] - worst.expected[1] == (worst.actual[1] > worst.expected[1] ? 50 : -50));
    CHECK(worst.actual[0] == worst.expected[0]);
    CHECK(comparison.metrics.worst[1].x == 5);
    CHECK(comparison.metrics.differing == 2);
    CHECK(comparison.reasons.at(0).find("off by 50 at (100, 60), allowed are 16") != std::string::npos);
    // Equal differences stay in reading order, and the list keeps its maximum length.
    const auto all = render::compare(flat(9, 9, {0, 0, 0}), flat(9, 9, {7, 7, 7}), {});
    REQUIRE(all.metrics.worst.size() == render::kWorstPixels);
    for (int k = 0; k < static_cast<int>(render::kWorstPixels); ++k)
        CHECK(all.metrics.worst[static_cast<std::size_t>(k)].x == k);
}

TEST_CASE("Black pixels of a mask do not count", "[compare]") {
    const Image good = balls();
    const Image bad = onePixel(good, 30, 40, 64);
    Image mask = flat(good.width, good.height, {255, 255, 255});
    CHECK_FALSE(render::compare(bad, good, {}, mask).passed());
    for (int channel = 0; channel < 3; ++channel)
        mask.rgb[static_cast<std::size_t>(3 * (40 * good.width + 30) + channel)] = 0;
    const auto masked = render::compare(bad, good, {}, mask);
    CHECK(masked.rule == render::CompareRule::identical);
    CHECK(masked.metrics.pixelCount == good.rgb.size() / 3 - 1);
    // Windows with a masked pixel do not count; all others are equal.
    CHECK(render::structuralSimilarity(bad, good, {}) < 1.0);
    CHECK(render::structuralSimilarity(bad, good, mask) == 1.0);
    CHECK_THROWS_AS(render::compare(bad, good, {}, flat(3, 3, {0, 0, 0})), std::invalid_argument);
}

TEST_CASE("Pictures of different sizes are reported as such", "[compare]") {
    const auto comparison = render::compare(balls(160, 90), balls(90, 160), render::limitsOf("loose"));
    CHECK(comparison.rule == render::CompareRule::size);
    CHECK(comparison.reasons == std::vector<std::string>{"the picture is 160x90, expected is 90x160"});
    CHECK_THROWS_AS(render::limitsOf("lose"), std::invalid_argument);
}

TEST_CASE("The difference image is sixteen times as bright, the heat map shows where it is", "[compare]") {
    const Image good = balls();
    const Image bad = onePixel(good, 30, 40, 5);
    const std::size_t at = 3 * (40 * 160 + 30);
    const Image difference = render::differenceImage(bad, good);
    CHECK(difference.rgb[at + 1] == 80);
    CHECK(std::count(difference.rgb.begin(), difference.rgb.end(), 0) == static_cast<long>(difference.rgb.size()) - 1);
    const Image heat = render::heatMap(bad, good);
    CHECK(heat.rgb[at] > 51);  // equal pixels are at most a fifth of 255
    for (std::size_t k = 0; k < heat.rgb.size(); ++k)
        if (k / 3 != at / 3 && heat.rgb[k] > 51) FAIL("pixel " << k / 3 << " is lit");
    CHECK(render::heatMap(blank(good), flat(160, 90, {255, 255, 255})).rgb ==
          std::vector<std::uint8_t>(good.rgb.size(), 255));
}
