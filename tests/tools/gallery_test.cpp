// Tests `globular gallery` on libraries of two tiny scenes: what it writes, what it keeps, and how a scene fails alone.
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"
#include "tools/pages/gallery_entry.h"

using program::textOf;

namespace {

namespace fs = std::filesystem;

constexpr const char* kTinyScene = R"(title = "Tiny: one <particle> & a floor"
description = "It falls; `globular check` reads it."
duration = 0.2
fps = 20
[material]
preset = "solid"
[[body]]
shape = "points"
positions = [[0, 1, 0]]
[[obstacle]]
shape = "plane"
[look]
style = "spheres"
size = [48, 32]
)";

/// An installed program with a library of its own, beside which it finds the scenes.
struct Installation {
    program::Folder folder;
    fs::path scenes = folder / "share/globular/scenes";
    fs::path gallery = folder / "gallery";

    Installation() {
        fs::create_directories(folder / "bin");
        fs::copy_file(GLOBULAR_PROGRAM, folder / "bin/globular");
        program::writeText(scenes / "one.toml", kTinyScene);
        program::writeText(scenes / "paper/two.toml", kTinyScene);
    }

    program::Outcome run(const std::string& more = "", const std::string& environment = "") const {
        return program::shell(environment + " " + (folder / "bin/globular").string() + " gallery --quiet -o " +
                              gallery.string() + " " + more);
    }
    nlohmann::json record(const std::string& name) const {
        return nlohmann::json::parse(textOf(gallery / (name + ".json")));
    }
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A gallery has film, still, text and record of every scene, and a page that shows them", "[gallery]") {
    const Installation program;
    const auto outcome = program.run("--threads 1");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const std::string page = textOf(program.gallery / "index.html");
    for (const std::string name : {"one", "paper/two"}) {
        CHECK(textOf(program.gallery / (name + ".mp4")).size() > 500);
        CHECK(textOf(program.gallery / (name + ".png")).starts_with("\x89PNG"));
        CHECK(textOf(program.gallery / (name + ".toml")) == kTinyScene);
        CHECK(program.record(name)["particles"] == 1);
        CHECK(program.record(name)["threads"] == 1);
        for (const std::string extension : {".mp4", ".png", ".toml"}) CHECK(contains(page, name + extension));
    }
    for (const char* part :
         {"Tiny: one &lt;particle&gt; &amp; a floor", "1 particles, 0.2 s of animation", "Measured with 1 thread with ",
          "globular render two -o out/two --video out/two.mp4", "<td>style</td>"})
        CHECK(contains(page, part));
    CHECK_FALSE(contains(page, "<particle>"));
    CHECK_FALSE(contains(page, "://"));  // nothing is fetched from elsewhere
}

TEST_CASE("What is done is kept, and drawn again only if it would be another picture", "[gallery]") {
    const Installation program;
    REQUIRE(program.run().code == 0);
    const auto timeOf = [&](const std::string& name) { return fs::last_write_time(program.gallery / name); };
    const auto one = timeOf("one.mp4");
    const auto two = timeOf("paper/two.mp4");
    REQUIRE(program.run().code == 0);
    CHECK(timeOf("one.mp4") == one);
    program::writeText(program.scenes / "one.toml", std::string(kTinyScene) + "gloss = 7\n");
    fs::remove(program.gallery / "paper/two.png");
    REQUIRE(program.run("--scenes one").code == 0);
    CHECK(timeOf("one.mp4") != one);
    CHECK(timeOf("paper/two.mp4") == two);
    REQUIRE(program.run("--scenes paper").code == 0);  // as after an interruption: the still is missing
    CHECK(timeOf("paper/two.mp4") != two);
    const auto again = timeOf("paper/two.mp4");
    REQUIRE(program.run("--scenes two --size 32x32").code == 0);
    CHECK(timeOf("paper/two.mp4") != again);
    CHECK(program.record("paper/two")["gallery"]["size"] == nlohmann::json({32, 32}));
}

TEST_CASE("A scene that cannot be drawn does not lose the others, and the exit code tells", "[gallery]") {
    const Installation program;
    program::writeText(program.scenes / "bad.toml", "title = \"bad\"\nduration = -1\n");
    const auto outcome = program.run();
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, "bad.toml:2:12: "));
    CHECK(contains(outcome.err, "error: 1 of 3 scenes could not be drawn, the first of them bad"));
    CHECK(fs::exists(program.gallery / "one.mp4"));
    CHECK(fs::exists(program.gallery / "paper/two.json"));
    CHECK_FALSE(fs::exists(program.gallery / "bad.json"));
    CHECK(contains(textOf(program.gallery / "index.html"), "Not drawn: "));
}

TEST_CASE("A gallery is refused before anything is drawn", "[gallery]") {
    const Installation program;
    const auto unknown = program.run("--scenes on");
    CHECK(unknown.code == 2);
    CHECK(contains(unknown.err, "one"));
    const auto withoutEncoder = program.run("", "PATH=/nowhere");
    CHECK(withoutEncoder.code == 1);
    CHECK(contains(withoutEncoder.err, "install ffmpeg"));
    CHECK_FALSE(fs::exists(program.gallery));
    program::writeText(program.gallery / "notes.txt", "mine");
    const auto occupied = program.run();
    CHECK(occupied.code == 2);
    CHECK(contains(occupied.err, "is no gallery"));
    CHECK_FALSE(fs::exists(program.gallery / "index.html"));
}

TEST_CASE("Films may be pictures that move, and Markdown shows the stills", "[gallery]") {
    const Installation program;
    const auto outcome = program.run("--film webp --scenes one --quality draft --markdown");
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(textOf(program.gallery / "one.webp").starts_with("RIFF"));
    CHECK(contains(textOf(program.gallery / "index.html"), "src=\"one.webp\""));
    for (const char* part :
         {"# Gallery\n", "](one.png)\n", "    globular render one -o out/one --video out/one.webp --quality draft\n",
          "It falls; `globular check` reads it.\n", "[Scene file](../scenes/library/one.toml)"})
        CHECK(contains(outcome.out, part));
}

TEST_CASE("A record of other pictures, or no record, is no run", "[gallery]") {
    tools::GalleryRun run;
    run.particles = 7;
    run.seconds = 1.5;
    const tools::Json record = tools::galleryRecord({{"size", 3}}, run);
    const auto found = tools::galleryRunIn(record, {{"size", 3}});
    REQUIRE(found);
    CHECK(found->particles == 7);
    CHECK(found->seconds == 1.5);
    CHECK_FALSE(tools::galleryRunIn(record, {{"size", 4}}));
    CHECK_FALSE(tools::galleryRunIn(nullptr, nullptr));
    tools::Json damaged = record;
    damaged["steps"] = "many";
    CHECK_FALSE(tools::galleryRunIn(damaged, {{"size", 3}}));
    damaged.erase("steps");
    CHECK_FALSE(tools::galleryRunIn(damaged, {{"size", 3}}));
}

TEST_CASE("docs/gallery.md has every scene for readers with the words of its file", "[gallery][docs]") {
    const std::string page = textOf(fs::path(GLOBULAR_SOURCE) / "docs/gallery.md");
    const auto scenes = program::run("scenes --json");
    std::istringstream lines(scenes.out);
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto scene = nlohmann::json::parse(line);
        const std::string name = scene["name"];
        if (name.starts_with("hard/") || name.starts_with("measured/")) continue;
        INFO(name);
        CHECK(contains(page, "# " + scene["title"].get<std::string>() + "\n"));
        CHECK(contains(page, "](" + name + ".png)"));
        CHECK(fs::exists(fs::path(GLOBULAR_SOURCE) / "docs" / (name + ".png")));
        ++count;
    }
    CHECK(count > 30);
}
