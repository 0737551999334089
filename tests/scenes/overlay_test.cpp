// Tests the overlay of a scene: its keys, texts and ticks, and mistakes in it.
#include "tests/catch.h"

#include "scenes/build/overlay_text.h"
#include "scenes/view/frame_view.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

const std::string kSpeed = "[look]\ncolor_by = \"speed\"\ncolor_range = [0, 8]\n";

render::Overlay overlayAt(const std::string& text, double time, const scenes::Overrides& overrides = {}) {
    return scenes_test::viewAt(sceneOf(text, overrides), time).overlay;
}

Lines tickTexts(double low, double high) {
    Lines texts;
    for (const render::Tick& tick : scenes::ticksBetween(low, high)) texts.push_back(tick.text);
    return texts;
}

}  // namespace

TEST_CASE("a scene without [overlay] has no overlay") {
    const render::Overlay overlay = overlayAt(kBall + kSpeed, 1.0);
    CHECK(overlay.stamp.empty());
    CHECK(!overlay.scaleBar.has_value());
    CHECK(!overlay.colorBar.has_value());
}

TEST_CASE("the stamp shows the time with decimals that distinguish frames") {
    const std::string text = kBall + "[overlay]\ntime = true\n";
    CHECK(overlayAt(text, 0.0).stamp == "t = 0.00 s");
    CHECK(overlayAt(text, 1.25).stamp == "t = 1.25 s");
    CHECK(overlayAt(text, 11.0 / 30.0).stamp == "t = 0.37 s");
    CHECK(overlayAt("fps = 240\n" + text, 1.0 / 240.0).stamp == "t = 0.004 s");
    CHECK(overlayAt(kBall, 1.25, {"overlay.time=true"}).stamp == "t = 1.25 s");
}

TEST_CASE("the scale bar shows its length") {
    const render::Overlay overlay = overlayAt(kBall + "[overlay]\nscale_bar = 0.5\n", 0.0);
    REQUIRE(overlay.scaleBar.has_value());
    CHECK(overlay.scaleBar->length == 0.5F);
    CHECK(overlay.scaleBar->text == "50 cm");
    CHECK(!overlayAt(kBall + "[overlay]\nscale_bar = 0.5\n", 0.0, {"overlay.scale_bar=0"}).scaleBar.has_value());
    CHECK(scenes::lengthText(1.0) == "1 m");
    CHECK(scenes::lengthText(2.5) == "2.5 m");
    CHECK(scenes::lengthText(0.01) == "1 cm");
    CHECK(scenes::lengthText(0.002) == "2 mm");
    CHECK(scenes::lengthText(1500.0) == "1.5 km");
}

TEST_CASE("the color bar has the colors, the range and the unit of the look") {
    const render::Overlay overlay =
        overlayAt(kBall + kSpeed + "colors = [\"#000000\", \"#ffffff\"]\n[overlay]\ncolor_bar = true\n", 0.0);
    REQUIRE(overlay.colorBar.has_value());
    CHECK(overlay.colorBar->title == "speed (m/s)");
    CHECK(overlay.colorBar->colors == std::vector<glm::vec3>{glm::vec3(0.0F), glm::vec3(1.0F)});
    REQUIRE(overlay.colorBar->ticks.size() == 5);
    CHECK(overlay.colorBar->ticks.at(1).text == "2");
    CHECK(overlay.colorBar->ticks.at(1).position == 0.25F);
    const std::string age = kBall + "[look]\ncolor_by = \"age\"\n[overlay]\ncolor_bar = true\n";
    CHECK(overlayAt(age, 0.0).colorBar->title == "age (s)");
    CHECK(overlayAt(age, 0.0, {"overlay.color_label=since birth"}).colorBar->title == "since birth (s)");
}

TEST_CASE("ticks are round numbers within the range") {
    CHECK(tickTexts(0.0, 5.0) == Lines{"0", "1", "2", "3", "4", "5"});
    CHECK(tickTexts(0.0, 7.0) == Lines{"0", "2", "4", "6"});
    CHECK(tickTexts(0.0, 1.0) == Lines{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"});
    CHECK(tickTexts(0.0, 0.03) == Lines{"0.00", "0.01", "0.02", "0.03"});
    CHECK(tickTexts(-3.0, 3.0) == Lines{"-2", "0", "2"});
    CHECK(tickTexts(120.0, 480.0) == Lines{"200", "300", "400"});
    CHECK(tickTexts(0.0, 1e30) == Lines{"0", "2e+29", "4e+29", "6e+29", "8e+29", "1.0e+30"});
    CHECK(tickTexts(1e8, 1.0002e8) == Lines{"100000000", "100005000", "100010000", "100015000", "100020000"});
    CHECK(tickTexts(0.0, 3e-8) == Lines{"0", "1e-08", "2e-08", "3e-08"});
    for (const double high : {0.11, 0.9, 1.7, 2.0, 33.0, 470.0, 6.1e6}) {
        INFO(high);
        const auto ticks = scenes::ticksBetween(0.0, high);
        CHECK(ticks.size() >= 3);
        CHECK(ticks.size() <= 6);
        CHECK(ticks.front().position == 0.0F);
        for (std::size_t k = 1; k < ticks.size(); ++k) {
            CHECK(ticks[k].position <= 1.0F + 1e-6F);
            CHECK(ticks[k].position * high == Approx(std::stod(ticks[k].text)));
        }
    }
}

TEST_CASE("ink contrasts with the background unless it is given") {
    const std::string on = "[overlay]\ntime = true\n";
    const auto ink = [&](const std::string& background, const std::string& more) {
        const std::string look =
            "[look]\nbackground_top = \"" + background + "\"\nbackground_bottom = \"" + background + "\"\n";
        return overlayAt(kBall + look + on + more, 0.0).ink;
    };
    CHECK(ink("#ffffff", "").x < 0.05F);
    CHECK(ink("#000000", "").x > 0.8F);
    CHECK(ink("#000000", "ink = \"#ff0000\"\n") == glm::vec3(1.0F, 0.0F, 0.0F));
    CHECK(overlayAt(kBall + on + "size = 2.5\n", 0.0).size == 2.5F);
}

TEST_CASE("overlays that cannot be drawn are reported at their keys") {
    CHECK(problemsOf(kBall + "[overlay]\ncolor_bar = true\n") ==
          Lines{"pile.toml:7:13: color_bar is true, but colors by material have no scale; it needs look.color_by "
                "\"speed\" or \"age\""});
    CHECK(problemsOf(kBall + "[camera]\nprojection = \"orthographic\"\nhalf_height = 2\n[overlay]\nscale_bar = 8\n") ==
          Lines{"pile.toml:10:13: scale_bar is 8, 1.1 of the picture's width at the camera's target, must be at most "
                "0.8 of it (meters)"});
    CHECK(problemsOf(kBall + "[overlay]\nscale_bar = -1\n") ==
          Lines{"pile.toml:7:13: scale_bar is -1, must be >= 0 (meters)"});
    CHECK(problemsOf(kBall, {"overlay.scale_bar=100"}).at(0).rfind("--set overlay.scale_bar=100: scale_bar is", 0) ==
          0);
}

TEST_CASE("a scale bar has to fit at every camera of a path") {
    const std::string path = "[[camera]]\ntime = 0\n[[camera]]\ntime = 1\neye = [0, 0.2, 1]\n";
    CHECK(problemsOf(kBall + "[overlay]\nscale_bar = 2\n") == Lines{});
    CHECK(problemsOf(kBall + path + "[overlay]\nscale_bar = 2\n").size() == 1);
}
