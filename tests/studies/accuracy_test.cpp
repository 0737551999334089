// The study of accuracy on a dozen particles: what it reports must be what is known of the steppers.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/stepping/take_step.h"
#include "scenes/build/read_scene.h"
#include "studies/accuracy/accuracy.h"

using engine::StepperKind;
using studies::AccuracyRow;
using studies::SceneAccuracy;

namespace {

/// Twelve particles that are closer than their rest length and fly apart.
const char* const kDozen = R"(
title = "it's a dozen"
duration = 1
fps = 30
[physics]
gravity = [0, 0, 0]
step = 0.002
[material]
preset = "liquid"
[[body]]
shape = "grid"
center = [0, 0, 0]
counts = [3, 2, 2]
spacing = 0.2
jitter = 0.2
)";

scenes::Scene dozen(const scenes::Overrides& overrides = {}) {
    return scenes::readScene(kDozen, "dozen.toml", overrides);
}

studies::AccuracySettings shortSettings() {
    studies::AccuracySettings settings;
    settings.firstFrame = 1;
    settings.frameCount = 3;
    settings.stepsPerFrame = {4, 8, 16, 32};
    settings.errors = {1e-1, 1e-2};
    settings.rounds = 1;
    return settings;
}

SceneAccuracy studied(const scenes::Scene& scene, const studies::AccuracySettings& settings = shortSettings()) {
    return studies::measureAccuracy("dozen", scene, settings, [](const studies::WindowRun&, std::string_view) {});
}

/// The study of the dozen, which is made once for all test cases.
const SceneAccuracy& dozenStudied() {
    static const SceneAccuracy accuracy = studied(dozen());
    return accuracy;
}

std::vector<AccuracyRow> rowsOf(const SceneAccuracy& accuracy, StepperKind stepper) {
    std::vector<AccuracyRow> rows;
    for (const AccuracyRow& row : accuracy.rows)
        if (isOf(row.run.variant, stepper)) rows.push_back(row);
    return rows;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE("Halving the step of velocity Verlet quarters its error, that of symplectic Euler halves it", "[studies]") {
    for (const auto& [stepper, factor] :
         {std::pair{StepperKind::velocityVerlet, 4.0}, std::pair{StepperKind::symplecticEuler, 2.0}}) {
        const auto rows = rowsOf(dozenStudied(), stepper);
        REQUIRE(rows.size() == 4);
        for (std::size_t k = 1; k < rows.size(); ++k) {
            INFO(engine::nameOf(stepper) << " " << rows[k].run.variant.asked << " s: " << rows[k].rms << " radii");
            CHECK(rows[k].run.steps.count == 2 * rows[k - 1].run.steps.count);
            CHECK(rows[k].resolved);
            // At these steps the next term of the error is up to a quarter of the first.
            CHECK(rows[k - 1].rms / rows[k].rms == Approx(factor).epsilon(0.25));
            CHECK(rows[k].errorPerSecond == Approx(rows[k].rms / 0.1).epsilon(1e-12));  // 3 frames at 30 per second
        }
    }
}

TEST_CASE("The study's reference is fine enough, and the orders are those of the steppers", "[studies]") {
    const SceneAccuracy& accuracy = dozenStudied();
    double smallest = 1.0;
    for (const AccuracyRow& row : accuracy.rows) smallest = std::min(smallest, row.rms);
    CHECK(accuracy.reference.settled);
    CHECK(accuracy.reference.change <= 0.05 * smallest);
    CHECK(accuracy.reference.metric == studies::ErrorMetric::positions);
    CHECK(accuracy.particleCount == 12);
    REQUIRE(accuracy.orders.size() == engine::kSteppers.size() - 1);
    for (const studies::OrderRow& row : accuracy.orders) {
        INFO(engine::nameOf(row.stepper));
        REQUIRE(row.order);
        // The next term of the error, as above.
        CHECK(*row.order == Approx(engine::orderOf(row.stepper)).margin(0.3));
    }
}

TEST_CASE("A closed scene conserves its momenta", "[studies]") {
    for (const AccuracyRow& row : dozenStudied().rows) {
        INFO(nameOf(row.run.variant) << " " << row.run.variant.asked);
        CHECK(row.compared == 12);
        // In single precision a force and its opposite are summed with rounding errors of 6e-8 each.
        const double limit = row.run.variant.precision == engine::Precision::singles ? 1e-6 : 1e-13;
        CHECK(row.linearDrift <= limit);  // some hundred steps with one rounding error each
        CHECK(row.angularDrift <= limit);
        // Half of it arises because the damping uses the velocities of the step before.
        CHECK(std::abs(row.energyDrift) <= 0.2);
    }
}

TEST_CASE("The automatic stepper is compared with the best of the others", "[studies]") {
    const SceneAccuracy& accuracy = dozenStudied();
    REQUIRE(accuracy.autos.size() == 2);
    for (const studies::AutoRow& row : accuracy.autos) {
        if (!row.resolved) continue;
        const auto& best = row.evaluationsAtObtained;
        if (!best) continue;
        for (const AccuracyRow& other : accuracy.rows)
            if (other.run.variant.stepper != StepperKind::automatic && other.resolved &&
                other.rms <= row.obtained * accuracy.window)
                CHECK(best->cost <= other.run.evaluationCost * (1 + 1e-12));  // interpolation
    }
    // Some fixed run reaches the largest error that was asked for.
    CHECK(accuracy.autos[0].evaluationsAtAsked);
}

TEST_CASE("A run that blows up is reported as unstable", "[studies]") {
    // With damping this strong a single step of the paper's stepper moves a particle out of the world.
    const studies::Window window = studies::openWindow(dozen({"material.bd=1e16"}), 0, 2);
    const auto run = studies::runWindow(window, {StepperKind::symplecticEuler, 0.01, {}}, 60.0);
    REQUIRE(run.ending == studies::Ending::unstable);
    CHECK(run.failureMessage.find("unstable") != std::string::npos);
    SceneAccuracy accuracy;
    accuracy.name = "dozen";
    accuracy.rows = {studies::rowOf(window, run, {})};
    CHECK_FALSE(accuracy.rows[0].resolved);
    CHECK(studies::accuracyCsv({accuracy}).find("dozen,symplectic-euler,0.01,,unstable,,,,,positions,,no,") !=
          std::string::npos);
    accuracy.rows.push_back(accuracy.rows[0]);
    accuracy.rows[1].resolved = true;  // so that the plot has a curve and a key
    CHECK(studies::accuracyPlot(accuracy, studies::CostAxis::forceEvaluations).find("symplectic-euler (2 failed)") !=
          std::string::npos);
}

TEST_CASE("A study shows which runs of a stiff scene failed", "[studies]") {
    // At b_d = 1000 kg/s and 1 kg the fastest mode of the twelve decays at a rate of several thousand per second: too
    // fast for steps of 2 ms, slow for steps of 1/61440 s.
    auto settings = shortSettings();
    settings.firstFrame = 0;
    settings.stepsPerFrame = {16, 1024, 2048};
    settings.referenceBudget = 0.0;
    const SceneAccuracy accuracy = studied(dozen({"material.bd=1000"}), settings);
    const auto rows = rowsOf(accuracy, StepperKind::symplecticEuler);
    REQUIRE(rows.size() == 3);
    INFO(studies::accuracyCsv({accuracy}));
    CHECK((rows[0].run.ending == studies::Ending::unstable || rows[0].rms > 1.0));
    CHECK(rows[2].run.ending == studies::Ending::finished);
    CHECK(rows[2].rms < 0.01);
}

TEST_CASE("A scene in which no run finishes has no reference, and the error says why", "[studies]") {
    auto settings = shortSettings();
    settings.runLimit = 0.0;
    CHECK_THROWS_WITH(studied(dozen(), settings),
                      Catch::Matchers::Contains("there is no reference") && Catch::Matchers::Contains("too slow"));
}

TEST_CASE("A run that takes too long is given up and reported as too slow", "[studies]") {
    const scenes::Scene scene = dozen();
    const studies::Window window = studies::openWindow(scene, 0, 2);
    const auto run = studies::runWindow(window, {StepperKind::velocityVerlet, 1e-3, {}}, 0.0);
    CHECK(run.ending == studies::Ending::tooSlow);
    CHECK(studies::nameOf(run.ending) == "too slow");
    CHECK(run.steps.count == 34);  // one frame of two
}

TEST_CASE("Single precision differs from double by rounding errors only", "[studies]") {
    const auto doubles = rowsOf(dozenStudied(), StepperKind::velocityVerlet);
    std::vector<AccuracyRow> singles;
    for (const AccuracyRow& row : dozenStudied().rows)
        if (isOf(row.run.variant, StepperKind::velocityVerlet, engine::Precision::singles)) singles.push_back(row);
    REQUIRE(singles.size() == doubles.size());
    for (std::size_t k = 0; k < singles.size(); ++k) {
        INFO("step " << singles[k].run.variant.asked << ": " << doubles[k].rms << " and " << singles[k].rms);
        CHECK(singles[k].rms != doubles[k].rms);
        // Some hundred steps with rounding errors of 1e-7 each.
        CHECK(singles[k].rms == Approx(doubles[k].rms).margin(1e-4));
    }
}

TEST_CASE("In a chaotic scene errors are those of the bulk statistics", "[studies]") {
    // Elastic grains in a small container collide a hundred times per second.
    const auto gas = scenes::readScene(R"(
title = "gas"
duration = 2
fps = 30
[physics]
gravity = [0, 0, 0]
step = 0.001
[material]
preset = "powder"
mass = 0.1
bd = 0
[[body]]
shape = "grid"
center = [0, 0, 0]
counts = [3, 3, 3]
spacing = 0.2
jitter = 0.2
[[obstacle]]
shape = "container"
minimum = [-0.7, -0.7, -0.7]
maximum = [0.7, 0.7, 0.7]
restitution = 1
)",
                                       "gas.toml", {});
    studies::AccuracySettings settings = shortSettings();
    settings.frameCount = 55;
    settings.stepsPerFrame = {32, 64};
    settings.errors = {1e-1};
    settings.referenceBudget = 1.0;
    const SceneAccuracy accuracy = studied(gas, settings);
    INFO("the twin runs end " << accuracy.reference.twinSeparation << " radii apart");
    CHECK(accuracy.reference.metric == studies::ErrorMetric::statistics);
    for (const AccuracyRow& row : accuracy.rows)
        CHECK((row.run.ending != studies::Ending::finished || row.error == row.statistics));
    CHECK(dozenStudied().reference.metric == studies::ErrorMetric::positions);
}

TEST_CASE("The tables have a line for each row and a field for each column", "[studies]") {
    const std::vector<SceneAccuracy> scenes = {dozenStudied()};
    const std::size_t fixed = engine::kSteppers.size() - 1;
    const std::vector<std::pair<std::string, std::size_t>> tables = {
        {studies::accuracyCsv(scenes), (fixed + 1) * 4 + 2},
        {studies::ordersCsv(scenes), fixed},
        {studies::autosCsv(scenes), 2},
        {studies::referencesCsv(scenes), 1}};
    for (const auto& [text, rowCount] : tables) {
        const auto lines = linesOf(text);
        INFO(text);
        REQUIRE(lines.size() == rowCount + 1);
        const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
        for (const std::string& line : lines) CHECK(std::count(line.begin(), line.end(), ',') == commas);
        CHECK(lines[1].rfind("dozen,", 0) == 0);
    }
    CHECK(tables[0].first.find("nan") == std::string::npos);
    CHECK(tables[0].first.find("inf") == std::string::npos);
}

TEST_CASE("A plot has a curve for each stepper with resolved runs, and its title quoted", "[studies]") {
    SceneAccuracy accuracy = dozenStudied();
    const std::string script = studies::accuracyPlot(accuracy, studies::CostAxis::forceEvaluations);
    INFO(script);
    CHECK(script.find("it''s a dozen") != std::string::npos);
    CHECK(script.find("title \"velocity-verlet\"") != std::string::npos);
    for (AccuracyRow& row : accuracy.rows)
        if (row.run.variant.stepper == StepperKind::velocityVerlet) {
            row.resolved = false;
            row.run.ending = studies::Ending::unstable;
        }
    CHECK(studies::accuracyPlot(accuracy, studies::CostAxis::seconds).find("velocity-verlet") == std::string::npos);
}

TEST_CASE("A window that begins before the first birth is measured", "[studies]") {
    const auto late = scenes::readScene(R"(
title = "late"
duration = 1
fps = 10
[material]
preset = "liquid"
[[emitter]]
shape = "point"
position = [0, 1, 0]
interval = 0.2
start = 0.35
pick = "all"
jitter = 0
)",
                                        "late.toml", {});
    studies::AccuracySettings settings = shortSettings();
    settings.firstFrame = 2;
    settings.frameCount = 8;
    const SceneAccuracy accuracy = studied(late, settings);
    CHECK(accuracy.particleCount == 0);
    for (const AccuracyRow& row : accuracy.rows) CHECK(row.compared == 3);  // born at 0.55, 0.75 and 0.95 s
}

TEST_CASE(
    "A run with other births is compared over the particles present from the start, unless even the finest runs differ",
    "[studies]") {
    const studies::Window window = studies::openWindow(dozen(), 1, 3);
    std::vector<studies::WindowRun> runs;
    for (const double step : {0.004, 0.002})
        runs.push_back(studies::runWindow(window, {StepperKind::velocityVerlet, step, {}}, 60.0));
    runs.push_back(studies::runWindow(window, {StepperKind::symplecticEuler, 0.002, {}}, 60.0));
    const auto reference = [&] {
        return studies::findReference(window, runs, 1.0, [](const studies::WindowRun&, std::string_view) {});
    };
    CHECK_FALSE(reference().facts.birthsDiffer);
    runs.back().particles.birthTime.back() = 0.01;
    const studies::Reference coarse = reference();
    CHECK_FALSE(coarse.facts.birthsDiffer);
    CHECK(coarse.facts.metric == studies::ErrorMetric::positions);
    const AccuracyRow row = studies::rowOf(window, runs.back(), coarse);
    CHECK(row.compared == window.start.particles.count());
    CHECK(row.error == row.rms);
    CHECK(row.resolved);

    studies::Window empty = window;
    empty.start.particles = {};
    const AccuracyRow strange = studies::rowOf(empty, runs.back(), coarse);
    CHECK(strange.compared == 0);
    CHECK(std::isinf(strange.error));
    CHECK_FALSE(strange.resolved);

    runs[1].particles.birthTime.back() = 0.01;
    const studies::Reference fine = reference();
    CHECK(fine.facts.birthsDiffer);
    CHECK(fine.facts.metric == studies::ErrorMetric::statistics);
    CHECK(studies::rowOf(window, runs.back(), fine).error > 0.0);
}

TEST_CASE("The CSV leaves position errors empty if no particle was compared", "[studies]") {
    SceneAccuracy accuracy;
    accuracy.name = "a, b";
    accuracy.rows.resize(1);
    accuracy.rows[0].run.variant.stepper = StepperKind::leapfrog;
    const std::vector<std::string> lines = linesOf(studies::accuracyCsv({accuracy}));
    REQUIRE(lines.size() == 2);
    CHECK(lines[1].rfind("\"a, b\",leapfrog,0,,finished,,,0,0,positions,", 0) == 0);
}
