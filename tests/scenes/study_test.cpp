// Tests the [study] table of a scene, and its variants.
#include "scenes/model/study.h"

#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

TEST_CASE("a scene has a study only if it has a [study] table") {
    CHECK(!sceneOf(kBall).study.has_value());
    const scenes::Scene scene = sceneOf(
        kBall +
        "[study]\nnumber = 4\nobservable = \"position-error\"\nlimit = 0.5\nat_least = 0.1\npaper_must_fail = true\n"
        "paper_step = 0.02\nreference_step = 1e-3\nreference_stepper = \"implicit-damping\"\nvary = [\"fps=20\"]\n");
    REQUIRE(scene.study.has_value());
    CHECK(scene.study->number == 4);
    CHECK(scene.study->observable == scenes::Observable::positionError);
    CHECK(scene.study->limit == 0.5);
    CHECK(scene.study->atLeast == 0.1);
    CHECK(scene.study->paperMustFail);
    CHECK(scene.study->paperStep == 0.02);
    CHECK(scene.study->referenceStep == 1e-3);
    CHECK(scene.study->referenceStepper == engine::StepperKind::implicitDamping);
    CHECK(scene.study->vary == std::vector<std::string>{"fps=20"});
    CHECK(scene.study->quick.empty());
}

TEST_CASE("a study is part of the scene's hash and of its list of values") {
    const std::string study = "[study]\nnumber = 1\nobservable = \"fragments\"\nlimit = 0\n";
    const scenes::Scene scene = sceneOf(kBall + study);
    CHECK(scene.sceneHash != sceneOf(kBall).sceneHash);
    CHECK(scene.values.back().path.substr(0, 6) == "study.");
}

TEST_CASE("problems of a study are reported at their positions") {
    CHECK(problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"fragmets\"\nlimit = 1\n")
              .at(0)
              .find("pile.toml:8:14: observable is \"fragmets\", must be") == 0);
    CHECK(problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"order\"\n") ==
          scenes_test::Lines{"pile.toml:6:1: limit is missing, [study] needs it"});
    CHECK(
        problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"front-error\"\nlimit = 1\n") ==
        scenes_test::Lines{"pile.toml:8:14: reference_step is missing, observable \"front-error\" needs it (seconds)"});
    CHECK(problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"order\"\nlimit = 1\nat_least = 2\n") ==
          scenes_test::Lines{"pile.toml:10:12: at_least is 2, must be at most the limit, 1"});
    CHECK(problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"order\"\nlimit = 1\nvary = [\"fps=1\", 2]\n") ==
          scenes_test::Lines{"pile.toml:10:18: vary[1] is 2, must be a string"});
    CHECK(problemsOf(kBall + "[study]\nnumber = 1\nobservable = \"order\"\nlimit = 1\nvary = \"fps=1\"\n") ==
          scenes_test::Lines{"pile.toml:10:8: vary is \"fps=1\" (a string), must be a list of strings"});
}

TEST_CASE("a variant is a list of overrides") {
    CHECK(scenes::overridesOf("").empty());
    CHECK(scenes::overridesOf("fps=20; body[0].center=[1, 2, 3];duration=4") ==
          scenes::Overrides{"fps=20", "body[0].center=[1, 2, 3]", "duration=4"});
    CHECK(problemsOf(kBall, scenes::overridesOf("fps")).size() == 1);
}

TEST_CASE("a quick run has its own variants, otherwise all, otherwise the scene as it is") {
    scenes::Study study;
    CHECK(scenes::variantsOf(study, false) == std::vector<std::string>{""});
    study.vary = {"a=1", "a=2"};
    CHECK(scenes::variantsOf(study, true) == study.vary);
    study.quick = {"a=3"};
    CHECK(scenes::variantsOf(study, true) == study.quick);
    CHECK(scenes::variantsOf(study, false) == study.vary);
}

TEST_CASE("observables are listed in the order of their enumeration, each with a unique name and a line of help") {
    for (std::size_t k = 0; k < scenes::observables().size(); ++k) {
        const scenes::ObservableInfo& info = scenes::observables()[k];
        INFO(info.name);
        CHECK(static_cast<std::size_t>(info.observable) == k);
        CHECK(&scenes::infoOf(info.observable) == &info);
        CHECK(!info.help.empty());
    }
}
