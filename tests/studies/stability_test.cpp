// The hard cases are scenes. Whether ours passes them is asked of the program itself (hard_cases_tests).
#include <algorithm>
#include <set>

#include "scenes/build/library.h"
#include "tests/catch.h"

namespace {

std::vector<scenes::LibraryEntry> hardCases() {
    std::vector<scenes::LibraryEntry> cases;
    for (const scenes::LibraryEntry& entry : scenes::listScenes({GLOBULAR_SOURCE "/scenes/library"}))
        if (entry.name.rfind("hard/", 0) == 0) cases.push_back(entry);
    return cases;
}

}  // namespace

TEST_CASE("there are twenty hard cases, each with its own number") {
    std::set<int> numbers;
    for (const scenes::LibraryEntry& entry : hardCases()) {
        INFO(entry.name);
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        REQUIRE(scene.study.has_value());
        numbers.insert(scene.study->number);
    }
    CHECK(numbers.size() == 20);
    CHECK(*numbers.begin() == 1);
    CHECK(*numbers.rbegin() == 20);
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
