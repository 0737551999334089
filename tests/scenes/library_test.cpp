// Tests that built-in scenes are found by name.
#include "tests/catch.h"

#include "scenes/build/library.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::ScratchFolder;

namespace {

std::string resolved(const std::string& name, const std::string& root) {
    try {
        return scenes::resolveScene(name, root);
    } catch (const scenes::InputError& error) {
        return error.what();
    }
}

}  // namespace

TEST_CASE("scenes are found by full name, by last part and by path") {
    const ScratchFolder folder;
    const std::string liquid = folder.write("liquid.toml", kBall);
    const std::string figure = folder.write("paper/figure-2.toml", kBall);
    const std::string honey = folder.write("hard/honey.toml", kBall);
    folder.write("notes.txt", "");
    const std::string root = folder.path.string();
    CHECK(resolved("liquid", root) == liquid);
    CHECK(resolved("figure-2", root) == figure);
    CHECK(resolved("paper/figure-2", root) == figure);
    CHECK(resolved("hard/honey", root) == honey);
    CHECK(resolved(honey, "") == honey);
    // A path that does not exist is left to the reader, which reports it.
    CHECK(resolved("nowhere/x.toml", root) == "nowhere/x.toml");
}

TEST_CASE("for an unknown name the nearest is suggested") {
    const ScratchFolder folder;
    folder.write("liquid.toml", kBall);
    folder.write("a/twin.toml", kBall);
    folder.write("b/twin.toml", kBall);
    const std::string root = folder.path.string();
    CHECK(resolved("liqiud", root) == "liqiud: there is no such file or built-in scene, did you mean \"liquid\"?");
    CHECK(resolved("notes", root) ==
          "notes: there is no such file and no built-in scene of that name (`globular scenes` lists them)");
    CHECK(resolved("twin", root) == "twin: is ambiguous, it may be any of a/twin, b/twin");
    CHECK(resolved("a/twin", root) == (folder.path / "a/twin.toml").string());
}

TEST_CASE("scenes are listed by name with their titles") {
    const ScratchFolder folder;
    folder.write("b.toml", "title = \"mine\"\nduration = 1\n");
    folder.write("paper/a.toml", "title = \"A\"\n");
    folder.write("c.toml", "title = 3\n");
    folder.write("d.toml", "title = \"unclosed\n");
    CHECK(scenes::listScenes((folder.path / "none").string()).empty());
    const std::vector<scenes::LibraryEntry> entries = scenes::listScenes(folder.path.string());
    REQUIRE(entries.size() == 4);
    CHECK(entries[0].name == "b");
    CHECK(entries[0].title == "mine");
    CHECK(entries[0].path == (folder.path / "b.toml").string());
    CHECK(entries[1].name == "c");
    CHECK(entries[1].title == "");
    CHECK(entries[2].title == "");
    CHECK(entries[3].name == "paper/a");
    CHECK(entries[3].title == "A");
}
