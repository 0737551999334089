// Observables of runs whose values are known: made by hand, or of two particles with a closed form.
#include "studies/stability/observables.h"

#include <cmath>
#include <limits>

#include "tests/catch.h"
#include "tests/studies/handmade_runs.h"

using engine::Vec3;
using studies::Run;
using studies_test::frameOf;
using studies_test::runOf;
using studies_test::sceneWith;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The value of an observable for a run without a reference. more: TOML appended to the scene.
double ofRun(double (*observable)(const studies::ObservableInput&), const Run& run, const std::string& more = "") {
    return observable({sceneWith(more), run});
}

/// The value of an observable for a run with a reference.
double against(double (*observable)(const studies::ObservableInput&), const Run& run, const Run& reference) {
    return observable({sceneWith(""), run, &reference});
}

}  // namespace

TEST_CASE("momentum drift is relative to the momenta at the start") {
    const Run run = runOf({frameOf({{{1, 0, 0}, {0, 2, 0}}, {{-1, 0, 0}, {0, -2, 0}}}),
                           frameOf({{{1, 0, 0}, {0, 2.004, 0}}, {{-1, 0, 0}, {0, -2, 0}}})});
    // Both the linear momentum and the angular momentum about z change by 0.004, of sums of 2 + 2.
    CHECK(ofRun(studies::momentumDrift, run) == Approx(0.001).epsilon(1e-9));
    CHECK(ofRun(studies::momentumDrift, runOf({run.frames[0], run.frames[0]})) == 0.0);
}

TEST_CASE("the energy rise is the kinetic energy gained per step") {
    Run run = runOf({frameOf({{{0, 0, 0}, {10, 0, 0}}}), frameOf({{{0, 0, 0}, {10.1, 0, 0}}})});
    // (102.01 - 100)/2 J over the sum of 102.01/2 J and 0.05^2/2 J, the energy of a tenth of a radius per second.
    const double expected = 2.01 / (102.01 + 0.0025);
    CHECK(ofRun(studies::energyRise, run) == Approx(expected).epsilon(1e-9));
    run.stepsUntil = {0, 4};
    CHECK(ofRun(studies::energyRise, run) == Approx(expected / 4.0).epsilon(1e-9));
    const Run braked = runOf({run.frames[1], run.frames[0]});
    CHECK(ofRun(studies::energyRise, braked) == 0.0);
}

TEST_CASE("the largest speed is that of all frames, the median speed that of the last") {
    const Run run = runOf({frameOf({{{0, 0, 0}, {0, 9, 0}}, {{2, 0, 0}, {0, 0, 0}}, {{4, 0, 0}, {0, 0, 0}}}),
                           frameOf({{{0, 0, 0}, {0, 1, 0}}, {{2, 0, 0}, {3, 0, 0}}, {{4, 0, 0}, {0, 0, 2}}})});
    CHECK(ofRun(studies::largestSpeed, run) == 9.0);
    CHECK(ofRun(studies::medianSpeed, run) == 2.0);
}

TEST_CASE(
    "errors are in radii, over the frames or at the end, and infinite between runs with different particle counts") {
    const Run reference = runOf(
        {frameOf({{{0, 0, 0}}, {{1, 3, 0}, {0, 0, 0}, 5.0}}), frameOf({{{0, 0, 0}}, {{1, 2, 0}, {0, 0, 0}, 5.0}})});
    const Run run = runOf({frameOf({{{0, 0, 0}}, {{1.25, 3.5, 0}, {0, 0, 0}, 5.0}}),
                           frameOf({{{0, 0, 0}}, {{1, 2.1, 0}, {0, 0, 0}, 5.0}})});
    CHECK(against(studies::positionError, run, reference) == Approx(std::sqrt(0.5 * 0.2 * 0.2)));
    CHECK(against(studies::heightError, run, reference) ==
          Approx(1.0));                                                  // of the heavier one: 0.5 m in the first frame
    CHECK(against(studies::frontError, run, reference) == Approx(0.5));  // 0.25 m in the first frame
    const Run fewer = runOf({frameOf({{{0, 0, 0}}}), frameOf({{{0, 0, 0}}})});
    CHECK(against(studies::positionError, fewer, reference) == kInfinity);
    CHECK(studies::positionError({sceneWith(""), run}) == kInfinity);
}

TEST_CASE("errors of R90 are in radii, those of all statistics relative") {
    const auto pair = [](double half) { return runOf({frameOf({{{-half, 1, 0}}, {{half, 1, 0}}})}); };
    // R90 of two particles is their distance from the middle. They differ by 0.1 m, which is 0.2 radii.
    CHECK(against(studies::radiusError, pair(1.1), pair(1.0)) == Approx(0.2));
    CHECK(against(studies::statisticsError, pair(1.1), pair(1.0)) == Approx(0.1));
    const Run raised = runOf({frameOf({{{-1, 1.05, 0}}, {{1, 1.05, 0}}})});
    CHECK(against(studies::statisticsError, raised, pair(1.0)) == Approx(0.05));
}

TEST_CASE("errors of rebound and restitution are relative to the reference") {
    const auto speeds = [](double a, double b) {
        return runOf({frameOf({{{0, 0, 0}, {0, -9, 0}}, {{3, 0, 0}, {0, -9, 0}, 3.0}}),
                      frameOf({{{0, 0, 0}, {0, a, 0}}, {{3, 0, 0}, {0, b, 0}, 3.0}})});
    };
    // The center of mass rises with (1 + 3 * 1)/4 m/s and, in the reference, (1 + 3 * 2)/4 m/s.
    CHECK(against(studies::reboundError, speeds(1, 1), speeds(1, 2)) == Approx(1.0 - 4.0 / 7.0));
    CHECK(against(studies::restitutionError, speeds(1.1, 1.5), speeds(1, 2)) == Approx(0.25));
}

TEST_CASE("fragments are particles that no chain within reach of the attraction connects to the largest cluster") {
    const std::string solid = "[material]\npreset = \"solid\"\n";
    // With rest length 1 and reach 2, three particles form a chain 1.9 m apart and two another one, 5 m away.
    const Run run = runOf({frameOf({{{0, 0, 0}}, {{1.9, 0, 0}}, {{3.8, 0, 0}}, {{0, 5, 0}}, {{1.9, 5, 0}}})});
    CHECK(ofRun(studies::fragments, run, solid) == 2.0);
    CHECK(ofRun(studies::fragments, run, solid + "cr = 1.5\n") == 4.0);
}

TEST_CASE("spacing is 1 at the least energy of a pair") {
    const auto pair = [](double distance) { return runOf({frameOf({{{0, 0, 0}}, {{distance, 0, 0}}})}); };
    const std::string solid = "[material]\npreset = \"solid\"\n";
    // The energy of two particles is least at the rest length, 1 m. The spacings tried are 0.005 of it apart.
    CHECK(ofRun(studies::spacing, pair(1.0), solid) == Approx(1.0).margin(0.005));
    CHECK(ofRun(studies::spacing, pair(0.5), solid) == Approx(0.5).margin(0.005));
}

TEST_CASE("the pair law of every preset is the slope of its energy") {
    const std::string presets =
        "[[material]]\npreset = \"liquid\"\n[[material]]\npreset = \"solid\"\nradius = 0.4\n[[material]]\npreset = "
        "\"powder\"\ncore = 0.5\n";
    const double difference = ofRun(studies::pairLaw, {}, presets);
    CHECK(difference < 1e-12);  // a few hundred roundings of sums of 300 terms
    CHECK(difference > 0.0);
}

TEST_CASE("the step bound of two particles is the largest stable step") {
    // The bisection ends within 1 %, and a growth of less than 3.5 % per step counts as stable.
    const std::string pair =
        "[material]\npreset = \"solid\"\nbd = 0\n[[body]]\nshape = \"points\"\npositions = [[9, 0, 0], [9.3, 0, 0]]\n";
    const scenes::Scene scene = sceneWith(pair, {"body[0].center=[90, 0, 0]", "body[0].radius=0.1"});
    for (const char* stepper : {"symplectic-euler", "velocity-verlet"}) {
        const scenes::Scene chosen = sceneWith(
            pair, {"body[0].center=[90, 0, 0]", "body[0].radius=0.1", std::string("physics.stepper=") + stepper});
        const Run run = studies::runScene(chosen);
        CHECK(studies::stepBound({chosen, run}) == Approx(1.0).margin(0.05));
    }
}

TEST_CASE("the measured order is that of the stepper") {
    const auto orderOf = [](const std::string& stepper) {
        // Two particles that oscillate about their rest length.
        const scenes::Scene scene = sceneWith(
            "[material]\npreset = \"solid\"\n[[body]]\nshape = \"points\"\npositions = [[9, 0, 0], [9.32, 0, 0]]\n",
            {"body[0].center=[90, 0, 0]", "body[0].radius=0.1", "physics.step=0.0001", "physics.stepper=" + stepper});
        const Run run = studies::runScene(scene);
        return studies::order({scene, run});
    };
    CHECK(orderOf("symplectic-euler") == Approx(1.0).margin(0.1));
    CHECK(orderOf("velocity-verlet") == Approx(2.0).margin(0.1));
    CHECK(orderOf("linearly-implicit") == Approx(2.0).margin(0.1));
}

TEST_CASE("refused births are counted") {
    // Three nozzles at one position: their particles need 0.9 m, and an interval is 0.4 m.
    const scenes::Scene scene = sceneWith(
        "[[emitter]]\npositions = [[5, 0, 0], [5, 0, 0], [5, 0, 0]]\nvelocity = [8, 0, 0]\ninterval = 0.05\n"
        "pick = \"all\"\n");
    const Run run = studies::runScene(scene);
    const double asked = static_cast<double>(engine::askedCount(scene.setup.emitters[0], run.end.time));
    CHECK(asked >= 3.0);
    CHECK(studies::refusals({scene, run}) == asked - static_cast<double>(engine::birthCount(run.end)));
    CHECK(studies::refusals({scene, run}) > 0.0);
}

TEST_CASE("errors leave out the frames before the first birth") {
    const Run reference = runOf({frameOf({}), frameOf({{{1, 2, 0}}})});
    const Run run = runOf({frameOf({}), frameOf({{{1.5, 2.25, 0}}})});
    CHECK(against(studies::heightError, run, reference) == Approx(0.5));
    CHECK(against(studies::frontError, run, reference) == Approx(1.0));
    const Run sooner = runOf({frameOf({{{1, 2, 0}}}), frameOf({{{1, 2, 0}}})});
    CHECK(against(studies::heightError, sooner, reference) == kInfinity);
}

TEST_CASE("a run without particles at the end has no observables but two") {
    const Run run = runOf({frameOf({}), frameOf({})});
    for (const scenes::ObservableInfo& info : scenes::observables()) {
        if (info.observable == scenes::Observable::pairLaw || info.observable == scenes::Observable::refusals) continue;
        INFO(info.name);
        CHECK_THROWS_WITH(studies::measure(info.observable, {sceneWith(""), run, &run}),
                          Catch::Matchers::Contains("no particle is there at the end"));
    }
}
