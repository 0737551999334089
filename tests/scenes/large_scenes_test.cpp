// Tests that the scenes of a hundred thousand particles and more load and start well.
#include "tests/catch.h"

#include <fstream>
#include <string>
#include <vector>

#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "scenes/warnings/start_warnings.h"

TEST_CASE("the large scenes load, are large, and start with particles where they are meant to be", "[long]") {
    const std::vector<scenes::LibraryEntry> entries = scenes::listScenes(GLOBULAR_SOURCE "/scenes/large");
    CHECK(entries.size() == 3);
    for (const scenes::LibraryEntry& entry : entries) {
        INFO(entry.name);
        CHECK(!entry.title.empty());
        std::string line;
        std::ifstream file(entry.path);
        REQUIRE(std::getline(file, line));
        CHECK(line.substr(0, 2) == "# ");
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        CHECK(scene.setup.initial.count() > 100000);
        CHECK(scenes::startWarnings(scene).empty());
    }
}
