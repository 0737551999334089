// Tests loads.csv: that its numbers are those of run.json, and that it has the same bytes for any number of threads and
// however often the run was interrupted.
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <vector>

#include "tests/catch.h"
#include "tests/tools/early_ends.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

/// Drops on a recorded floor of which a paddle takes some along.
constexpr const char* kPaddleScene = R"(title = "a paddle"
duration = 1
fps = 20
[physics]
stepper = "velocity-verlet"
step = 0.005
[material]
preset = "liquid"
radius = 0.1
[[body]]
shape = "box"
minimum = [-0.5, 0.2, -0.3]
maximum = [0.5, 0.8, 0.3]
[[obstacle]]
shape = "sphere"
center = [0, 0, 5]
radius = 0.5
[[obstacle]]
shape = "plane"
record = true
[[obstacle]]
shape = "box"
center = [-1.2, 0.5, 0]
size = [0.2, 1, 1]
velocity = [2, 0, 0]
until = 0.5
)";

struct PaddleScene {
    program::Folder folder;
    std::string file = (folder / "s.toml").string();

    PaddleScene() { program::writeText(file, kPaddleScene); }

    std::string simulate(const std::string& name, const std::string& more = "") const {
        return "simulate " + file + " --quiet -o " + (folder / name).string() + " " + more;
    }
    std::string loads(const std::string& name) const { return textOf(folder / name / "loads.csv"); }
};

using LoadRow = std::vector<double>;

std::vector<LoadRow> rowsOf(const std::string& csv) {
    std::vector<LoadRow> rows;
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);  // the head
    while (std::getline(lines, line)) {
        LoadRow& row = rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    }
    return rows;
}

}  // namespace

TEST_CASE("loads.csv has a row for each interval and recorded obstacle, up to the sums in run.json", "[loads]") {
    const PaddleScene scene;
    REQUIRE(run(scene.simulate("a")).code == 0);
    CHECK(scene.loads("a").rfind("time_s,obstacle,force_x_N,", 0) == 0);
    const std::vector<LoadRow> rows = rowsOf(scene.loads("a"));
    REQUIRE(rows.size() == 2 * 19);
    const auto report = early_ends::runOf(scene.folder / "a")["obstacles"];
    for (const std::size_t k : {0U, 1U}) {
        LoadRow sums(6, 0.0);
        for (std::size_t frame = 1; frame < 20; ++frame) {
            const LoadRow& row = rows[2 * (frame - 1) + k];
            REQUIRE(row.size() == 12);
            CHECK(row[0] == static_cast<double>(frame) / 20.0);
            CHECK(row[1] == 2.0 + static_cast<double>(k));
            for (std::size_t axis = 0; axis < 6; ++axis) sums[axis] += row[2 + axis] / 20.0;
        }
        const LoadRow& last = rows[rows.size() - 2 + k];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            INFO("obstacle " << k + 2 << ", axis " << axis);
            CHECK(last[8 + axis] == report[k]["impulse"][axis]);
            // Two roundings for each of 19 terms of up to 100 N s.
            CHECK(sums[axis] == Approx(last[8 + axis]).margin(40 * 100 * 2.3e-16));
            CHECK(sums[3 + axis] ==
                  Approx(report[k]["angular_impulse"][axis].get<double>()).margin(40 * 100 * 2.3e-16));
        }
        CHECK(last[11] == report[k]["work"]);
    }
    CHECK(rows.front()[3] <= 0.0);  // the floor is pushed down
    CHECK(rows[rows.size() - 2][9] < -1.0);
    CHECK(rows[2 * 9 + 1][8] < -0.1);  // the paddle is pushed back
    for (std::size_t frame = 11; frame < 20; ++frame) CHECK(rows[2 * (frame - 1) + 1][2] == 0.0);  // and then gone
}

TEST_CASE("loads.csv is the same for any number of threads, of `render`, and after interruptions", "[loads]") {
    const PaddleScene scene;
    REQUIRE(run(scene.simulate("whole", "--threads 1")).code == 0);
    const std::string whole = scene.loads("whole");
    REQUIRE(program::lineCount(whole) == 1 + 2 * 19);

    REQUIRE(run(scene.simulate("threads", "--threads 3")).code == 0);
    CHECK(scene.loads("threads") == whole);

    REQUIRE(run("render " + scene.file + " --size 32x18 --frames 7,19 --quiet -o " + (scene.folder / "drawn").string())
                .code == 0);
    CHECK(scene.loads("drawn") == whole);

    const std::string often = scene.simulate("a", "--checkpoint 0 --resume");
    early_ends::interrupted(often, "KILL",
                            early_ends::onceThat("[ -e " + (scene.folder / "a/loads.csv").string() + " ]"),
                            scene.folder / "log");
    REQUIRE(fs::exists(scene.folder / "a/loads.csv"));
    fs::remove(scene.folder / "a/loads.csv");  // the checkpoints know what was in it
    REQUIRE(run(often).code == 0);
    CHECK(early_ends::runOf(scene.folder / "a")["resumed_from"].is_number());
    CHECK(scene.loads("a") == whole);

    // Checkpoints that are shorter than the manifest says are not used.
    const fs::path manifest = scene.folder / "a/manifest.json";
    program::writeText(manifest, std::regex_replace(textOf(manifest), std::regex("\"load_bytes\":"), "$&9999"));
    REQUIRE(run(often).code == 0);
    CHECK(early_ends::runOf(scene.folder / "a")["resumed_from"].is_null());
    CHECK(scene.loads("a") == whole);

    // A shorter run has fewer rows, and the longer one goes on from its own checkpoint.
    REQUIRE(run(scene.simulate("a", "--frames 0-9 --resume")).code == 0);
    CHECK(program::lineCount(scene.loads("a")) == 1 + 2 * 9);
    REQUIRE(run(often).code == 0);
    CHECK(early_ends::runOf(scene.folder / "a")["resumed_from"] == 19);
    CHECK(scene.loads("a") == whole);
}

TEST_CASE("Only a run with recorded obstacles writes loads.csv, and none replaces another program's", "[loads]") {
    const PaddleScene scene;
    REQUIRE(run("simulate measured/liquid --frames 0-2 --quiet -o " + (scene.folder / "a").string()).code == 0);
    CHECK(fs::exists(scene.folder / "a/run.json"));
    CHECK(!fs::exists(scene.folder / "a/loads.csv"));

    REQUIRE(run(scene.simulate("b", "--frames 0-2")).code == 0);
    REQUIRE(fs::exists(scene.folder / "b/loads.csv"));
    CHECK(run(scene.simulate("b", "--frames 0-2 --set seed=2")).code == 1);
    CHECK(run(scene.simulate("b", "--frames 0-3 --set seed=2 --overwrite")).code == 0);
    CHECK(program::lineCount(scene.loads("b")) == 1 + 2 * 3);

    const std::string chunk = "render " + scene.file + " --size 32x18 --quiet --chunk 2/2 -o ";
    REQUIRE(run(chunk + (scene.folder / "c").string()).code == 0);
    CHECK(!fs::exists(scene.folder / "c/loads.csv"));  // other chunks may be of the same frames

    program::writeText(scene.folder / "b/loads.csv", "time,load\n0,1\n");
    const auto foreign = run(scene.simulate("b", "--frames 0-2 --overwrite"));
    CHECK(foreign.code == 2);
    CHECK(foreign.err.find("loads.csv") != std::string::npos);
    CHECK(scene.loads("b") == "time,load\n0,1\n");
}
