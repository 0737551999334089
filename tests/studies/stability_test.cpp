// The study of stability: the hard cases as scenes, limits compared with values, variants run, results as text. Whether
// the program passes the hard cases is asked of the program itself, in hard_cases_tests.
#include "studies/stability/stability.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "tests/catch.h"

namespace {

/// A temporary scene file.
class SceneFile {
 public:
    explicit SceneFile(const std::string& text)
        : path_((std::filesystem::temp_directory_path() / "globular-case-XXXXXX.toml").string()) {
        const int handle = mkstemps(path_.data(), 5);
        REQUIRE(handle >= 0);
        close(handle);
        std::ofstream(path_) << text;
    }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;
    ~SceneFile() { std::filesystem::remove(path_); }

    const std::string& path() const { return path_; }

 private:
    std::string path_;
};

/// A light, stiff pair a little closer than its rest length. At the paper's step it flies apart.
const std::string kPair =
    "title = \"a stiff pair\"\nduration = 0.2\n[physics]\ngravity = [0, 0, 0]\nstepper = \"velocity-verlet\"\nstep = "
    "0.0001\n[material]\npreset = \"solid\"\nmass = 0.01\n[[body]]\nshape = \"points\"\npositions = [[0, 0, 0], [0.29, "
    "0, 0]]\n";

const std::string kStudy = "[study]\nnumber = 7\nobservable = \"largest-speed\"\n";

std::vector<scenes::LibraryEntry> hardCases() {
    std::vector<scenes::LibraryEntry> cases;
    for (const scenes::LibraryEntry& entry : scenes::listScenes(GLOBULAR_SOURCE "/scenes/library"))
        if (entry.name.rfind("hard/", 0) == 0) cases.push_back(entry);
    return cases;
}

}  // namespace

TEST_CASE("there are thirty-two hard cases, each with its own number") {
    std::set<int> numbers;
    for (const scenes::LibraryEntry& entry : hardCases()) {
        INFO(entry.name);
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        REQUIRE(scene.study.has_value());
        numbers.insert(scene.study->number);
    }
    CHECK(numbers.size() == 32);
    CHECK(*numbers.begin() == 1);
    CHECK(*numbers.rbegin() == 32);
}

TEST_CASE("every variant of every hard case is a scene") {
    for (const scenes::LibraryEntry& entry : hardCases()) {
        const scenes::Study study = *scenes::loadScene(entry.path, {}).study;
        for (const bool quick : {false, true})
            for (const std::string& variant : scenes::variantsOf(study, quick)) {
                INFO(entry.name << " " << variant);
                CHECK_NOTHROW(scenes::loadScene(entry.path, scenes::overridesOf(variant)));
            }
    }
}

TEST_CASE("the limit ratio is the larger of value over limit and lower limit over value") {
    scenes::Study study;
    study.limit = 2.0;
    CHECK(studies::limitRatio(study, 1.0) == 0.5);
    CHECK(studies::limitRatio(study, 3.0) == 1.5);
    CHECK(studies::limitRatio(study, std::numeric_limits<double>::quiet_NaN()) ==
          std::numeric_limits<double>::infinity());
    study.atLeast = 1.0;
    CHECK(studies::limitRatio(study, 0.5) == 2.0);
    CHECK(studies::limitRatio(study, 1.0) == 1.0);
    CHECK(studies::limitRatio(study, 0.0) == std::numeric_limits<double>::infinity());
    study = {};
    CHECK(studies::limitRatio(study, 0.0) == 0.0);
    CHECK(studies::limitRatio(study, 1.0) > 1.0);
}

TEST_CASE("a case passes if its own stepper passes in every variant and the paper's fails where it must") {
    const SceneFile file(kPair + kStudy +
                         "limit = 10\npaper_must_fail = true\nvary = [\"\", \"material.mass=0.02\"]\nquick = [\"\"]\n");
    const studies::CaseResult result = studies::runCase({"pair", file.path(), false});
    REQUIRE(result.variants.size() == 2);
    CHECK(result.variants[1].changes == "material.mass=0.02");
    CHECK(result.variants[0].ours.value < 10.0);
    CHECK(result.variants[0].ours.steps.count >= 2000);
    CHECK(result.variants[0].paper.value > 10.0);
    CHECK(studies::oursPasses(result));
    CHECK(studies::paperIsAsExpected(result));
    CHECK(studies::stabilityProblems({result}).empty());
    CHECK(studies::runCase({"pair", file.path(), true}).variants.size() == 1);
}

TEST_CASE("a case fails if its own stepper exceeds the limit, or if the paper's stepper passes where it must fail") {
    const SceneFile strict(kPair + kStudy + "limit = 1e-6\n");
    const studies::CaseResult failed = studies::runCase({"strict", strict.path(), false});
    CHECK(!studies::oursPasses(failed));
    CHECK(studies::stabilityProblems({failed}).find("strict []: largest-speed, m/s is") == 0);
    CHECK(studies::rowOf(failed)[7] == "FAIL");

    const SceneFile lax(kPair + kStudy + "limit = 1e9\npaper_must_fail = true\n");
    const studies::CaseResult passed = studies::runCase({"lax", lax.path(), false});
    CHECK(studies::oursPasses(passed));
    CHECK(!studies::paperIsAsExpected(passed));
    CHECK(studies::stabilityProblems({passed}) == "lax []: the paper's stepper passes, must fail\n");
    CHECK(studies::rowOf(passed)[7] == "paper passes");
}

TEST_CASE("an unstable run is reported as a failure with its time") {
    const SceneFile file(kPair + kStudy + "limit = 10\n");
    const studies::CaseResult result = studies::runCase({"pair", file.path(), false});
    studies::Outcome outcome = result.variants[0].paper;
    outcome.failure = studies::Failure{0.25, "gone"};
    CHECK(studies::outcomeText(outcome) == "exploded at 0.25 s");
}

TEST_CASE("the table shows the worst variant, the CSV all of them") {
    const SceneFile file(kPair + kStudy +
                         "limit = 10\nat_least = 1e-9\nvary = [\"\", \"physics.gravity=[0, -3, 0]\"]\n");
    const studies::CaseResult result = studies::runCase({"pair", file.path(), false});
    CHECK(&studies::worstVariant(result, &studies::VariantResult::ours) ==
          &result.variants[result.variants[0].ours.value > result.variants[1].ours.value ? 0 : 1]);
    CHECK(studies::rowOf(result)[6] == "1e-09 to 10");
    const std::string csv = studies::stabilityCsv({result});
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
    const std::string header = csv.substr(0, csv.find('\n'));
    const std::string second = csv.substr(csv.find('\n') + 1, csv.find('\n', csv.find('\n') + 1) - csv.find('\n') - 1);
    CHECK(std::count(header.begin(), header.end(), ',') == std::count(second.begin(), second.end(), ','));
    CHECK(csv.find("7,pair,\"physics.gravity=[0, -3, 0]\",largest-speed,m/s,10,1e-09,symplectic-euler,") !=
          std::string::npos);
}

TEST_CASE("a scene without [study] is refused") {
    const SceneFile file(kPair);
    CHECK_THROWS_AS(studies::runCase({"pair", file.path(), false}), scenes::InputError);
}

TEST_CASE("a row names the observable of the paper's stepper if it is not the observable of the row") {
    studies::CaseResult result;
    result.name = "two";
    result.variants.resize(2);
    studies::VariantResult& front = result.variants[0];
    front.study.observable = scenes::Observable::frontError;
    front.ours.value = 0.9;
    front.paper.value = 1.5;
    studies::VariantResult& radius = result.variants[1];
    radius.study.observable = scenes::Observable::radiusError;
    radius.ours.value = 0.1;
    radius.paper.value = 7.0;
    for (studies::VariantResult& variant : result.variants) variant.study.limit = 1.0;
    CHECK(studies::rowOf(result)[2] == "radius-error 7: fails");
    radius.study.observable = scenes::Observable::frontError;
    CHECK(studies::rowOf(result)[2] == "7: fails");
}
