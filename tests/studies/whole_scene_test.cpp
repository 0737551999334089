// The study of accuracy in whole scenes: nothing that the automatic stepper spends is left out, and the best fixed
// stepper and step are found.
#include "studies/accuracy/whole_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "engine/error_control/step_cost.h"
#include "scenes/build/read_scene.h"
#include "studies/accuracy/step_ladder.h"
#include "studies/accuracy/whole_windows.h"
#include "studies/common/state_difference.h"
#include "tests/catch.h"

using engine::StepperKind;
using studies::LadderPoint;

namespace {

/// Twelve particles in space that attract each other and swing, while another one is emitted beside them.
scenes::Scene swinging() {
    return scenes::readScene(R"(
title = "swinging"
duration = 1
fps = 30
[physics]
stepper = "auto"
error = 0.05
gravity = [0, 0, 0]
[material]
preset = "liquid"
[[body]]
shape = "grid"
center = [0, 0, 0]
counts = [3, 2, 2]
spacing = 0.25
jitter = 0.2
[[emitter]]
shape = "point"
position = [3, 0, 0]
interval = 1
start = 0.45
pick = "all"
jitter = 0
)",
                             "swinging.toml", {});
}

studies::WholeSettings quickSettings() {
    studies::WholeSettings settings;
    settings.windowCount = 2;
    settings.rounds = 1;
    return settings;
}

void ignore(const studies::WindowRun&, std::string_view) {}

/// A stepper of second order: error = step^2, at a cost of 1 / step.
LadderPoint secondOrder(double step) {
    return {step, step * step, 1.0 / step, 0.0};
}

}  // namespace

TEST_CASE("The study of a whole scene counts the steps and the trial runs of a plain run", "[studies]") {
    const scenes::Scene scene = swinging();
    engine::Simulation plain = engine::start(scene.setup);
    studies::timeFrames(scene, plain, 0, 29, studies::kInfinity);
    REQUIRE(plain.automatic.estimateCost > 0.0);

    const studies::WholeScene whole = studies::measureWhole("swinging", scene, quickSettings(), ignore);
    CHECK(whole.trialEvaluations == plain.automatic.estimateCost);
    CHECK(whole.runEvaluations == engine::forceEvaluationsOf(plain));
    CHECK(whole.evaluationCost() == whole.runEvaluations + whole.trialEvaluations);
    const auto best = bestBy(whole.fixed, &studies::FixedWholeRun::evaluationCost);
    REQUIRE(best);
    const double ratio = (whole.runEvaluations + whole.trialEvaluations) / best->evaluationCost;
    CHECK(studies::wholeSentence({whole}).find(fmt::format("at most {:.2f} times the force", ratio)) !=
          std::string::npos);
    CHECK(studies::wholeCsv({whole}).find(fmt::format(",{:.6g},", ratio)) != std::string::npos);
}

TEST_CASE("A window of the automatic stepper is charged with its trial runs", "[studies]") {
    for (const int firstFrame : {0, 6}) {
        const studies::Window window = studies::openWindow(swinging(), firstFrame, 6);
        const auto run = studies::runWindow(window, {StepperKind::automatic, 0.05, {}}, 60.0);
        INFO("from frame " << firstFrame);
        CHECK(run.errorEstimateCost > 0.0);
        CHECK(run.evaluationCost ==
              Approx(static_cast<double>(run.steps.forceEvaluations) + run.errorEstimateCost).epsilon(1e-12));
        CHECK(run.leadIn.has_value() == (firstFrame > 0));
        const auto again = studies::runWindow(window, run.variant, 60.0, run.leadIn);
        CHECK(again.evaluationCost == run.evaluationCost);
        CHECK(engine::squaredLength(again.particles.position[0] - run.particles.position[0]) == 0.0);
    }
}

TEST_CASE("The fixed steppers of a whole scene meet the wanted error", "[studies]") {
    const studies::WholeScene whole = studies::measureWhole("swinging", swinging(), quickSettings(), ignore);
    REQUIRE(whole.windows.size() == 2);
    CHECK(whole.windows[0].from == Approx(0.167).margin(0.02));  // a quarter of what the windows may begin in
    CHECK(whole.change < 0.1 * whole.meanError);
    CHECK(whole.largestError >= whole.meanError);
    REQUIRE_FALSE(whole.fixed.empty());
    for (const studies::FixedWholeRun& run : whole.fixed) CHECK(run.error <= whole.wanted);
}

TEST_CASE("The error in a window is that of the particles that it began with", "[studies]") {
    auto windows = studies::runAutomatically(swinging(), 1, 0.2).windows;
    REQUIRE(windows.size() == 1);
    studies::WholeWindow& window = windows[0];
    window.reference = window.automatic;
    REQUIRE(window.automatic.nextId > window.window.start.particles.nextId);  // one was born
    engine::Particles moved = window.automatic;
    moved.position.back().x() += 1.0;
    CHECK(studies::errorOf(window, moved) == 0.0);
    for (std::size_t p = 0; p < moved.count(); ++p) moved.position[p].y() += 0.1 * moved.radius[p];
    const double seconds = window.window.seconds();
    CHECK(studies::errorOf(window, moved) == Approx(0.1 / seconds).epsilon(1e-9));
    engine::keepWhere(moved, [](std::size_t p) { return p != 0; });
    moved.position[0].y() = window.automatic.position[1].y();
    const double others = static_cast<double>(window.window.start.particles.count() - 1);
    CHECK(studies::errorOf(window, moved) == Approx(0.1 / seconds * std::sqrt((others - 1) / others)).epsilon(1e-9));
}

TEST_CASE("The longest step within an error is read off the ladder", "[studies]") {
    const auto found = studies::longestWithin({secondOrder(0.2), secondOrder(0.4), secondOrder(0.1)}, 0.09);
    REQUIRE(found);
    CHECK(found->step == Approx(0.3).epsilon(1e-12));  // a power law is interpolated exactly
    CHECK(found->error == 0.09);
    CHECK(found->evaluations == Approx(1.0 / 0.3).epsilon(1e-12));
    CHECK(studies::longestWithin({secondOrder(0.2), secondOrder(0.4)}, 0.5)->step == 0.4);
    CHECK_FALSE(studies::longestWithin({secondOrder(0.2), secondOrder(0.4)}, 0.01));
    CHECK(studies::longestWithin({secondOrder(0.2), {0.4, studies::kInfinity, 1.0, 0.0}}, 0.09)->step == 0.2);
    // Rejections make the longest step that meets the error more expensive than a shorter one.
    CHECK(studies::longestWithin({secondOrder(0.1), secondOrder(0.2), {0.4, 0.05, 100.0, 0.5}}, 0.09)->step == 0.2);
}

TEST_CASE("The ladder is walked to both sides of the wanted error, past steps that cost too much", "[studies]") {
    std::vector<double> asked;
    const auto run = [&](double step) -> std::optional<LadderPoint> {
        asked.push_back(step);
        return step < 0.02 ? std::nullopt : std::optional(secondOrder(step));
    };
    for (const double first : {0.01, 0.04, 0.9}) {
        asked.clear();
        const auto points = studies::walkLadder(run, 1.0, first, 0.04);
        INFO("from " << first);
        REQUIRE(studies::longestWithin(points, 0.04));
        CHECK(studies::longestWithin(points, 0.04)->step == Approx(0.2).epsilon(1e-12));
        CHECK(asked.size() <= 12);  // rungs from 0.01 to 0.25
    }
    // Rejections make long steps expensive: nothing is cheap before 1/8 of a frame, and 1/16 is best.
    const auto rejecting = [](double step) -> std::optional<LadderPoint> {
        if (step > 0.125) return std::nullopt;
        return LadderPoint{step, 1e-3, std::abs(std::log2(step) + 4.0), 0.5};
    };
    CHECK(studies::longestWithin(studies::walkLadder(rejecting, 1.0, 0.25, 0.04), 0.04)->step == 0.0625);
    CHECK(studies::walkLadder(run, 1.0, 0.9, 1e-6).back().step >= 0.02);
    const auto longest = studies::walkLadder(run, 1.0, 0.3, 2.0);
    CHECK(longest.back().step == 1.0);
}

TEST_CASE("The cheapest step that divides a frame is found between the rungs of the ladder", "[studies]") {
    const auto run = [](double step) { return std::optional(secondOrder(step)); };
    for (const double count : {1.0, 2.0, 5.0, 13.0}) {
        INFO("frame over " << count);
        const double wanted = 1.001 / (count * count);
        auto points = studies::walkLadder(run, 1.0, 0.1, wanted);
        const auto found = studies::refine(points, run, 1.0, wanted);
        REQUIRE(found);
        CHECK(found->step == Approx(1.0 / count).epsilon(1e-12));
    }
    std::vector<LadderPoint> none = {secondOrder(0.5)};
    CHECK_FALSE(studies::refine(none, run, 1.0, 0.1));
}

TEST_CASE("The best fixed run is that with the least of what is asked for", "[studies]") {
    const std::vector<studies::FixedWholeRun> runs = {{StepperKind::velocityVerlet, 0.01, 0.05, 100.0, 3.0},
                                                      {StepperKind::leapfrog, 0.01, 0.05, 120.0, 2.0}};
    CHECK(bestBy(runs, &studies::FixedWholeRun::evaluationCost)->stepper == StepperKind::velocityVerlet);
    CHECK(bestBy(runs, &studies::FixedWholeRun::seconds)->stepper == StepperKind::leapfrog);
    CHECK_FALSE(bestBy({}, &studies::FixedWholeRun::seconds));
}
